/// The pictures of a pile run.
#pragma once

#include "apps/view/options.h"
#include "dem/io/table.h"

namespace mergel::apps {

/// load.png, damage.png and displacement.png, and those of fields and profiles where the run
/// wrote some.
void draw_pile(const Options& options, const dem::Table& history);

/// load.png alone, with the measured curves of --compare over it.
void draw_pile_load(const Options& options, const dem::Table& history);

} // namespace mergel::apps
