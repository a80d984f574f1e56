/// Yield points and peaks of several tests in the plane of q and p.
#pragma once

#include "apps/laboratory/test_series.h"
#include "apps/view/page.h"

namespace mergel::apps {

/// Why there is nothing to draw: fewer than two yield points and peaks; empty: there is.
std::string lacks_of_yield(const TestSeries& series);

/// Yield by the offset method, peaks, isotropic yield, the stress paths to them, and the
/// Coulomb line at the peak and the critical state line where there are such.
void draw_yield(Page& page, const TestSeries& series);

} // namespace mergel::apps
