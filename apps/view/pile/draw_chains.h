/// Force chains around a pile, over the damage of the particles behind them.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"

#include <string>

namespace mergel::apps {

/// Whole, and around the tip.
void draw_chains(Page& page, const ResultFrame& frame, const ContinuumFrame& continuum,
                 const std::string& caption);

} // namespace mergel::apps
