/// Critical time step from the stiffness that each particle feels.
#pragma once

#include "dem/pairs/forces.h"
#include "dem/particles/integrate.h"
#include "dem/walls/mirror.h"
#include "dem/walls/surfaces.h"
#include "dem/walls/triangulated.h"

namespace mergel::dem {

/// Stiffness that resists the motion of each particle.
struct StiffnessSums {
  std::vector<double> k;     ///< sum of normal stiffnesses [N/m]
  std::vector<double> k_rot; ///< sum of 2 k_s a^2 + 2 k_b [N m]
};

StiffnessSums stiffness_sums(const PairMaterials& material, const PeriodicCell& cell,
                             const Particles& p, const Bonds& bonds,
                             const Contacts& contacts);

/// Walls, image and pile add theirs.
void add_wall_stiffness(StiffnessSums& s, const BondLaw& bond, const Particles& p,
                        const Wall& wall);
void add_surface_stiffness(StiffnessSums& s, const LinearMaterial& material,
                           const Particles& p, const SurfaceContacts& contacts);
void add_mirror_stiffness(StiffnessSums& s, const PairMaterials& material,
                          const Particles& p, const Mirror& mirror);

/// s min[ sqrt(2 m/sum k), sqrt(2 I_p/sum(2 k_s a^2 + 2 k_b)) ] / sqrt(1 + alpha) [s].
///
/// A pair of masses m on a spring k has omega^2 = 2 k/m at most, stable to 2/omega; local
/// damping acts as 1 + alpha times the force while it brakes.
/// Spin counts where the rotation rule lets a particle spin.
/// Of the owned particles: the least of all ranks is the step.
/// @param safety in (0, 1]
double time_step(const StiffnessSums& s, const Particles& p, double safety,
                 const Motion& motion);

/// Over owned particles, the magnitudes of the pair forces on them [N].
ForceSum sum_of_pair_forces(const Particles& p, const PairMaterials& material,
                            const PeriodicCell& cell, const Bonds& bonds,
                            const Contacts& contacts);

} // namespace mergel::dem
