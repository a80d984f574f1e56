/// A bound of the stable step from the springs at each particle (dem/README.md, Time step).
#pragma once

#include "dem/assembly/springs.h"

namespace mergel::dem {

/// The particle whose own springs are the stiffest for its mass.
struct StiffestParticle {
  double omega2 = 0.0; ///< bound of the squared frequency of the system [1/s^2]
  std::uint64_t id = 0;
  double S = 1.0;        ///< of the particle [-]
  double rotation = 0.0; ///< share of the spin in the motion of this frequency [-]
};

/// Twice the largest eigenvalue of M_i^-1/2 B_i M_i^-1/2 over all particles, B_i the 6x6
/// block of particle i: the sum over its springs while all else is held. Springs to held
/// walls count half. It is never below the largest squared frequency of the undamped system
/// of particles, because |a + b|^2 <= 2 |a|^2 + 2 |b|^2. Collective.
StiffestParticle block_bound(const Assembly& assembly, const Springs& springs);

/// The same bound of each owned particle, 0 for others [1/s^2].
std::vector<double> block_bounds(const Assembly& assembly, const Springs& springs);

} // namespace mergel::dem
