/// The symmetry plane of a half model: a particle near it acts on its own mirror image
/// (dem/README.md, Symmetry plane).
#pragma once

#include "dem/pairs/forces.h"

#include <concepts>
#include <tuple>
#include <vector>

namespace mergel::dem {

/// A particle and its image behind the plane y = 0; the particles are at y >= 0.
///
/// The gap to the image is 2 (y - R) and changes twice as fast as the particle moves. By
/// symmetry there is no shear, and a bonded particle can spin about the normal of the plane
/// only. Half of the energy of the pair belongs to the particle.
struct MirrorPair {
  Index particle = 0;
  double gap_0 = 0.0;       ///< gap at which the bond was made [m]
  BondState bond{0.0, 0.0}; ///< intact = 0: no bond
};

/// The symmetry plane, with bonds to the images, or without as a smooth wall that carries
/// no tension (`Specimen/symmetry` = mirror or wall).
struct Mirror {
  std::vector<MirrorPair> pairs; ///< ascending in particle
  VectorSum force;               ///< of the plane on owned particles [N]
};

/// Candidates: gap to the image below (g_a + 2 skin) S plus twice their extra reach
/// (VerletList); bonded pairs always stay.
void rebuild_wall(Mirror& mirror, const PairMaterials& material, const Particles& p,
                  double skin, const std::vector<double>& extra = {});

/// Bond each particle whose gap to its image is below limit S [m]; of its spin only the y
/// component is kept. Once for a mirror, else std::logic_error.
void bond_to_mirror(Mirror& mirror, Particles& p, double limit);

/// Add the forces of the images over the step dt [s].
/// @throws NumericalError for a centre behind the plane
void add_wall_forces(Mirror& mirror, const PairMaterials& material, double dt, Particles& p,
                     PairLosses& losses);

/// Stored by bonds and contacts of owned particles, half of each pair [J].
EnergySum stored_energy(const Mirror& mirror, const PairMaterials& material,
                        const Particles& p);

/// Set the x and z torques of bonded particles to zero, which symmetry excludes. To be
/// called after all forces are added: a torque added later would spin a bonded particle and
/// add energy.
void constrain_mirror_spin(const Mirror& mirror, Particles& p);

/// The plane does not move.
inline double travel(const Mirror&)
{
  return 0.0;
}

/// The records that belong to a particle and migrate with it.
inline auto histories(Mirror& mirror)
{
  return std::tie(mirror.pairs);
}

/// Show each exact sum, with its name, to `visit(name, kind, sum)`.
template <class Wall, class Visit>
requires std::same_as<std::remove_const_t<Wall>, Mirror>
void visit_sums(Wall& mirror, Visit&& visit)
{
  visit("force", SumKind::by_rank, mirror.force);
}

} // namespace mergel::dem
