/// The specimen of a triaxial test between its platens: seen through its membrane, and cut
/// open.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"
#include "dem/io/table.h"

namespace mergel::apps {

/// Two views along +y, axes in mm: all particles behind the membrane, and the half y >= 0
/// without it; above them strain, q and broken bonds of the history at this time.
/// @throws InputError when the history lacks one of these
void draw_specimen(Page& page, const SpecimenFrame& frame, const dem::Table& history);

} // namespace mergel::apps
