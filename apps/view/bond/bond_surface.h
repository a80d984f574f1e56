/// Load paths of a bond and its shrinking yield surface, as in the paper's Fig. 5.
#pragma once

#include "apps/view/bond/bond.h"
#include "apps/view/page.h"

#include <vector>

namespace mergel::apps {

/// The paths of the loads in the planes (N, M), (N, V) and (V, M) of the loads that act,
/// with the yield surface of the intact bond, f = m + n^2 + v^4/(1 - n^2) - 1 = 0, and that
/// surface times 1 - D where the path reaches some values of D.
///
/// Tension and compression have separate panels, because the strengths differ tenfold. A
/// plane of two loads shows the section of the surface at the third load of the bond at
/// that D, so that the path crosses each section at its marker. Runs of equal strengths
/// without a third load share one family of sections.
/// @pre every run has_surface
void draw_bond_surface(Page& page, const std::vector<BondRun>& runs);

/// Number of panels of the picture, two in a row.
std::size_t n_surface_panels(const std::vector<BondRun>& runs);

} // namespace mergel::apps
