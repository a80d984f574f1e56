/// Porosity of grains in a region, by true sphere volumes.
#pragma once

#include "dem/particles/particles.h"
#include "dem/specimen/region.h"

namespace mergel::dem {

double solid_volume(const Particles& p); ///< of all spheres [m^3]

/// Porosity further from every boundary than one largest diameter [-]: the share of a grid's
/// points, a tenth of the smallest diameter apart at most, that lie in no sphere. A wall
/// orders the grains beside it and leaves voids there, so the porosity of the whole region
/// says little of the rock. A periodic box is core throughout: its solid volume is exact.
double core_porosity(const Region& region, const Particles& p);

} // namespace mergel::dem
