/// Cone resistance, head force and broken bonds against depth.
#pragma once

#include "apps/view/laboratory/measured.h"
#include "apps/view/page.h"
#include "dem/io/table.h"

#include <vector>

namespace mergel::apps {

/// Add the column "head force [N]", tip and shaft force of the full pile together, where there
/// is none of that name.
void add_head_force(dem::Table& history);

/// Depth in pile diameters, downwards. Measured curves of `q_c` or `head force` over `depth`,
/// `depth/D_p` or `tip depth` are laid over those of the run; other columns are left out.
/// @throws InputError when a measured heading names no column of the history, or has a unit that
///   does not fit
void draw_load(Page& page, const dem::Table& history,
               const std::vector<Measured>& measured);

} // namespace mergel::apps
