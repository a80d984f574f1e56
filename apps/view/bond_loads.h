/// What a bond bears against what it is made to do, as the paper's Fig. 4.
#pragma once

#include "apps/view/bond.h"
#include "apps/view/page.h"

#include <vector>

namespace mergel::apps {

/// Normal force against normal displacement and shear force against shear displacement
/// (bond and contact together, and the bond alone), moment against rotation, each if that
/// motion occurs in a run; damage against the length of the path. Runs lie on each other.
void draw_bond_loads(Page& page, const std::vector<BondRun>& runs);

} // namespace mergel::apps
