/// Runs that differ only by seed as one curve.
#pragma once

#include "apps/view/options.h"
#include "apps/view/run_plot.h"

#include <vector>

namespace mergel::apps {

/// The mean of these histories at the axial strains of the first, as far as all reach, without
/// unloading and reloading; `error` has the standard errors. The run has number and label.
/// @param runs two or more, with a column "axial strain"
Run mean_of(const std::vector<Run>& runs, const RunName& name);

/// As they are, or with --mean the mean of each group that differs only by seed in place of
/// its runs.
/// @param runs of the folders, in their order
/// @throws InputError when a folder tells no case, or no two runs differ only by seed
std::vector<Run> as_asked(const Options& options, std::vector<Run> runs);

} // namespace mergel::apps
