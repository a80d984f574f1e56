/// Plots of runs of `mergel element` and `mergel triaxial`, as usual in rock mechanics.
#pragma once

#include "apps/laboratory/stages.h"
#include "apps/view/run_plot.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// For the title of an axis: "axial strain from stage 2 on".
void name_stages(PlotQuantity& quantity, const Stages& stages);

/// Whether the deviator stress is negligible in all runs: |q| below 1 % of the largest p.
bool is_isotropic(const std::vector<Run>& runs);

/// q and volumetric strain over axial strain; q and void ratio over p. The volumetric strain
/// of a triaxial test is that of its middle third.
std::vector<RunPlot> element_plots(const std::vector<Run>& runs, const Stages& stages);

/// p over volumetric strain; void ratio over log p.
std::vector<RunPlot> isotropic_plots(const std::vector<Run>& runs, const Stages& stages);

} // namespace mergel::apps
