/// Stable time step from the stiffness that resists the motion of each particle
/// (dem/README.md, Time step).
#pragma once

#include "dem/pairs/forces.h"
#include "dem/particles/integrate.h"
#include "dem/walls/mirror.h"
#include "dem/walls/rigid_wall.h"
#include "dem/walls/triangulated.h"

namespace mergel::dem {

/// Share of the critical time step that is used where nothing else is asked for [-].
inline constexpr double default_safety = 0.7;

/// Steps after which the critical time step, and what else costs more than a step, is
/// evaluated again.
inline constexpr std::size_t steps_between_step_checks = 100;

/// Stiffness that resists the motion of each particle.
struct StiffnessSums {
  std::vector<double> k;     ///< sum of normal stiffnesses [N/m]
  std::vector<double> k_rot; ///< sum of 2 k_s a^2 + 2 k_b [N m]
};

StiffnessSums stiffness_sums(const PairMaterials& material, const PeriodicCell& cell,
                             const Particles& p, const Bonds& bonds,
                             const Contacts& contacts);

/// Add the stiffness of a wall: of its contacts that press, and of its bonds.
void add_wall_stiffness(StiffnessSums& s, const Mirror& mirror,
                        const PairMaterials& material, const Particles& p);
void add_wall_stiffness(StiffnessSums& s, const Wall& wall, const PairMaterials& material,
                        const Particles& p);
void add_wall_stiffness(StiffnessSums& s, const RigidWall& wall,
                        const PairMaterials& material, const Particles& p);

/// s min[ sqrt(2 m/sum k), sqrt(2 I_p/sum(2 k_s a^2 + 2 k_b)) ] / sqrt(1 + alpha) [s].
///
/// A pair of masses m on a spring k has omega^2 = 2 k/m at most, and leapfrog is stable to
/// 2/omega. Local damping acts as 1 + alpha times the force while it brakes. The rotational
/// term counts for particles that may spin (dem/README.md, Motion).
/// Minimum over the owned particles; the step is the global min of it.
/// @param safety in (0, 1]
double time_step(const StiffnessSums& s, const Particles& p, double safety,
                 const Motion& motion);

/// Sum of the magnitudes of the pair forces, each counted for both particles [N]. Pairs
/// whose first particle is owned.
ForceSum sum_of_pair_forces(const Particles& p, const PairMaterials& material,
                            const PeriodicCell& cell, const Bonds& bonds,
                            const Contacts& contacts);

} // namespace mergel::dem
