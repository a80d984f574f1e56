/// Porosity of particles in a region, by sphere volumes.
#pragma once

#include "dem/particles/particles.h"
#include "dem/specimen/region.h"

namespace mergel::dem {

double solid_volume(const Particles& p); ///< sum of the sphere volumes [m^3]

/// Porosity of the core, the part further from every boundary than the largest diameter
/// [-]: share of the points of a grid that lie in no sphere. The grid spacing is a tenth of
/// the smallest diameter, and larger in regions of more than 1e8 points. Walls order the
/// particles beside them and leave voids, so the porosity of the whole region differs. A
/// periodic box has no walls: its porosity follows from the sum of the sphere volumes.
double core_porosity(const Region& region, const Particles& p);

} // namespace mergel::dem
