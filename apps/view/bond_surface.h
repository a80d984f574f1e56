/// How the loads of a bond follow its shrinking yield surface, as the paper's Fig. 5.
#pragma once

#include "apps/view/bond.h"
#include "apps/view/page.h"

#include <vector>

namespace mergel::apps {

/// The paths of the loads in the planes (N, M), (N, V) and (V, M) of the loads borne, with
/// the yield surface of the intact bond, f = m + n^2 + v^4/(1 - n^2) - 1 = 0, and that
/// surface times 1 - D where the path reaches some values of D.
///
/// Tension and compression have panels of their own: the strengths differ tenfold. A plane
/// of two loads shows the section of the surface at the third load which the bond bears at
/// that D, so that the path crosses each section where its marker is; where the runs bear
/// no third load and have one strength, they share one family of sections.
/// @pre every run has_surface
void draw_bond_surface(Page& page, const std::vector<BondRun>& runs);

/// How many panels that takes, two in a row.
std::size_t n_surface_panels(const std::vector<BondRun>& runs);

} // namespace mergel::apps
