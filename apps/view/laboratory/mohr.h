/// Mohr circles of several tests and the Coulomb line through them.
#pragma once

#include "apps/laboratory/test_series.h"
#include "apps/view/page.h"

namespace mergel::apps {

/// The panels that there are: at the peak, in the critical state.
std::size_t n_mohr_panels(const TestSeries& series);

/// Shear over normal stress, both to one scale; cohesion and friction angle with their
/// standard errors above each panel. @pre there is a panel
void draw_mohr(Page& page, const TestSeries& series);

} // namespace mergel::apps
