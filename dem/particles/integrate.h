/// Leapfrog with local non-viscous damping; velocities live at half steps.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/particles/particles.h"

namespace mergel::dem {

struct Motion {
  Vec3 gravity = Vec3::Zero(); ///< [m/s^2]
  double damping = 0.7;        ///< local damping alpha [-], 0 to below 1
  bool free_rotation = false;  ///< true lets unbonded particles spin
};

/// Work done on all owned particles by what the kick knows of, each exact for the leapfrog:
/// force at t^n times the mean velocity of n-1/2 and n+1/2.
struct KickWork {
  EnergySum gravity; ///< [J]
  EnergySum damping; ///< energy taken out [J], >= 0
  EnergySum lock;    ///< spin energy of particles that lost their last bond [J], >= 0
};

/// v^{n+1/2} = v^{n-1/2} + dt (f - alpha |f| sign v)/m with f = load + m g, component by
/// component; the same for the spin. Rotation rule (paper, section 2.1.2): a particle
/// without a living bond does not spin.
/// @param dt mean of the steps before and after [s]
void kick(Particles& p, const Motion& motion, double dt, KickWork& work);

/// x^{n+1} = x^n + dt v^{n+1/2}.
/// @throws NumericalError when a particle moves more than R/20 or turns more than 0.05 rad
///   in the step, or is not a number
void drift(Particles& p, double dt);

/// Both in one pass, the kick over `dt_kick` [s]. Returns the largest motion over S [m].
double kick_and_drift(Particles& p, const Motion& motion, double dt_kick, double dt,
                      KickWork& work);

/// Set the loads of owned particles and ghosts to zero.
void clear_loads(Particles& p);

/// Of the owned particles, at half step [J].
EnergySum kinetic_energy_sum(const Particles& p);
inline double kinetic_energy(const Particles& p)
{
  return kinetic_energy_sum(p).value();
}

/// Over the owned particles, the magnitude of the resultant force, gravity included [N].
ForceSum sum_of_resultants(const Particles& p, const Motion& motion);

} // namespace mergel::dem
