/// Curves over the depth of a pile, with depth downwards as usual in soil mechanics.
#pragma once

#include "apps/view/page.h"
#include "dem/io/table.h"

namespace mergel::apps {

/// Cone resistance (as recorded, and its mean over 0.1 D_p of travel) and number of broken
/// bonds against depth in pile diameters.
/// @throws InputError when the history lacks depth/D_p [-], q_c [Pa] or bonds broken [-]
void draw_load(Page& page, const dem::Table& history);

} // namespace mergel::apps
