/// Runs over each other in panels of any two quantities, points above them, one key for
/// all.
#pragma once

#include "apps/view/page.h"
#include "apps/view/points.h"
#include "apps/view/quantity.h"
#include "apps/view/run_name.h"
#include "dem/io/table.h"

#include <optional>
#include <vector>

namespace mergel::apps {

struct Run {
  RunName name;
  dem::Table history;
  /// Of a mean of several runs: standard errors of its history; drawn as a band over the
  /// axial strain.
  std::optional<dem::Table> error = {};
};

/// What one panel shows.
struct RunPlot {
  PlotQuantity x, y;
  Reach x_reach = Reach::from_zero, y_reach = Reach::from_zero;
};

/// Settles both quantities (quantity.h); axes include 0 unless the values are far from it.
/// @throws InputError when a run lacks a column
RunPlot plot_of(PlotQuantity x, PlotQuantity y, const std::vector<Run>& runs);

/// The curves of the runs in this panel.
Plot plot_of_runs(const RunPlot& plot, const std::vector<Run>& runs);

/// @throws InputError naming a file whose columns are the axes of no panel
void check_points(const std::vector<Points>& points, const std::vector<RunPlot>& plots);

/// All panels of the page.
void draw_runs(Page& page, const std::vector<RunPlot>& plots, const std::vector<Run>& runs,
               const std::vector<Points>& points);

} // namespace mergel::apps
