/// The pictures of several tests together.
#pragma once

#include "apps/view/options.h"

namespace mergel::apps {

/// mohr.png, critical_state.png and yield.png; for one that would mean nothing a line on the
/// terminal that says why. Nothing for one run.
void draw_laboratory(const Options& options);

} // namespace mergel::apps
