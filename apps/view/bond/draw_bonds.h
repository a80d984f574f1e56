/// The pictures of bond runs.
#pragma once

#include "apps/view/options.h"
#include "dem/io/table.h"

#include <vector>

namespace mergel::apps {

/// loads.png, and surface.png of those that have a yield surface.
void draw_bonds(const Options& options, const std::vector<dem::Table>& histories);

} // namespace mergel::apps
