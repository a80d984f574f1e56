/// The pictures of a pile run.
#pragma once

#include "apps/view/options.h"
#include "dem/io/table.h"

namespace mergel::apps {

/// damage.png, displacement.png and load.png.
void draw_pile(const Options& options, const dem::Table& history);

} // namespace mergel::apps
