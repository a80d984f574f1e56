/// Plots and picture of runs of `mergel brazilian`.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"
#include "apps/view/run_plot.h"
#include "dem/io/table.h"

#include <vector>

namespace mergel::apps {

/// Whether this is the history of a Brazilian test.
bool is_brazilian_history(const dem::Table& history);

/// 2P/(pi D t) and broken bonds over diametral strain.
std::vector<RunPlot> brazilian_plots(const std::vector<Run>& runs);

/// Two views along +y, axes in mm: the particles of the face, coloured by damage, and the
/// breaks through the whole thickness; each as the trace of a plane normal to its bond, as
/// long as the smaller particle is wide, coloured by its mode. Above them strain, stress and
/// broken bonds of the history at this time.
/// @throws InputError when the history lacks one of these
void draw_disc(Page& page, const DiscFrame& frame, const dem::Table& history);

} // namespace mergel::apps
