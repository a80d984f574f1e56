/// Loads of a bond against its imposed motion, as in the paper's Fig. 4.
#pragma once

#include "apps/view/bond/bond.h"
#include "apps/view/page.h"

#include <vector>

namespace mergel::apps {

/// Normal force against normal displacement and shear force against shear displacement
/// (bond and contact together, and the bond alone), moment against rotation, each if that
/// motion occurs in a run; damage against the length of the path. All runs in one panel.
void draw_bond_loads(Page& page, const std::vector<BondRun>& runs);

} // namespace mergel::apps
