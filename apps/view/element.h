/// Runs of `mergel element` as papers on the mechanics of rock draw them.
#pragma once

#include "apps/view/run_plot.h"
#include "dem/io/table.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// Whether this is the history of an element test, not of a pile or bond.
bool is_element_history(const dem::Table& history);

/// Which legs are drawn, counted from 1.
struct Legs {
  int first = 0; ///< 0: all, with the strains of the whole test
  int last = 0;  ///< 0: to the end of the test
  bool is_all() const { return first == 0; }
};

/// "2": from leg 2 on; "2-3": legs 2 and 3.
/// @throws InputError naming the text
Legs legs_of(const std::string& text);

/// The records of these legs. "axial strain" and "volumetric strain" count from where the
/// strain of the first of them counts; what comes before (the way to the stress that the
/// leg holds) is left out. "... of the leg" stay as they are.
/// @throws InputError naming the file when it holds no such leg
dem::Table from_legs(const dem::Table& history, const Legs& legs);

/// For the title of an axis: "axial strain from leg 2 on".
void name_legs(Quantity& quantity, const Legs& legs);

/// Whether no run has a deviator stress worth speaking of: |q| below 1 % of the largest p.
bool is_isotropic(const std::vector<Run>& runs);

/// q and volumetric strain over axial strain; q and void ratio over p.
std::vector<RunPlot> element_plots(const std::vector<Run>& runs, const Legs& legs);

/// p over volumetric strain; void ratio over log p.
std::vector<RunPlot> isotropic_plots(const std::vector<Run>& runs, const Legs& legs);

} // namespace mergel::apps
