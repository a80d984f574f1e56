/// Plots of runs of `mergel element` and `mergel triaxial`, as usual in rock mechanics.
#pragma once

#include "apps/view/run_plot.h"
#include "dem/io/table.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// Whether this is the history of an element test, not of a pile, bond or triaxial test.
bool is_element_history(const dem::Table& history);

/// Whether this is the history of a triaxial test.
bool is_triaxial_history(const dem::Table& history);

/// Which stages are drawn, counted from 1.
struct Stages {
  int first = 0; ///< 0: all, with the strains of the whole test
  int last = 0;  ///< 0: to the end of the test
  bool is_all() const { return first == 0; }
};

/// "2": from stage 2 on; "2-3": stages 2 and 3.
/// @throws InputError naming the text
Stages stages_of(const std::string& text);

/// The records of these stages. "axial strain" and "volumetric strain", and strains "of the
/// middle third", count from where the strain of the first of them counts; the approach to
/// the stress of that stage is left out. "... of the stage" stay as they are.
/// @throws InputError naming the file when it holds no such stage
dem::Table from_stages(const dem::Table& history, const Stages& stages);

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
