/// Critical states of several tests, with the line through them.
#pragma once

#include "apps/laboratory/test_series.h"
#include "apps/view/page.h"

namespace mergel::apps {

/// Void ratio over (p/p_a)^0.7, and q over p: paths, end states, fitted lines.
/// @pre series.critical_states has a line
void draw_critical_states(Page& page, const TestSeries& series);

} // namespace mergel::apps
