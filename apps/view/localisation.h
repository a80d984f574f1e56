/// The bands of a triaxial test: sections through the specimen across the slab in which its strain
/// is localised.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"
#include "dem/io/table.h"

#include <optional>

namespace mergel::apps {

/// The row of localisation.csv at the time of this frame; none where the run wrote none, as in an
/// isotropic stage.
std::optional<std::size_t> bands_at(double time, const dem::Table& localisation);

/// Two sections, axes in mm, each along the dip of its slab and through the axis of the specimen;
/// the half behind is seen. Colours are the shear strain of each particle over the mean of all: on
/// the left since the start of the test, on the right its increment. Full lines are the faces of
/// the slab, dashed ones those of a second slab that holds much of the rest.
/// @throws InputError when table or particles lack a column
void draw_localisation(Page& page, const SpecimenFrame& frame,
                       const dem::Table& localisation, std::size_t row);

} // namespace mergel::apps
