/// A surcharge on the free surface of a specimen: a flexible pressure on its topmost
/// particles.
#pragma once

#include "dem/particles/particles.h"
#include "dem/specimen/region.h"

namespace mergel::dem {

/// The force of a vertical pressure on each particle [N], downwards. A vertical line that
/// meets the specimen from above loads the first particle that it meets, so each particle has
/// the share of the area at which it is seen from above. The forces sum to pressure times
/// area.
/// @param p all particles
/// @param region a prism; its top is the surface
/// @param pressure [Pa], >= 0
/// @throws InputError where the region is a periodic box, which has no surface
std::vector<Vec3> surface_load(const Particles& p, const Region& region, double pressure);

} // namespace mergel::dem
