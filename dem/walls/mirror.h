/// The cut plane of a half model: each particle near it acts on its own mirror image.
#pragma once

#include "dem/pairs/forces.h"

#include <vector>

namespace mergel::dem {

/// A particle and its image behind the plane y = 0; the rock is at y >= 0.
///
/// The gap to the image is 2 (y - R) and moves twice as fast as the particle. By symmetry
/// there is no shear, and a bond to the image leaves spin along the plane's normal only.
/// Half of the energy of the pair belongs to the particle.
struct MirrorPair {
  Index particle = 0;
  double gap_0 = 0.0;
  BondState bond{0.0, 0.0}; ///< intact = 0: no bond
};

/// The symmetry plane, with a bond to the image (mirror) or as a smooth wall that holds no
/// tension.
struct Mirror {
  std::vector<MirrorPair> pairs; ///< ascending in particle
  EnergySum
      energy; ///< of bonds and contacts of owned grains, the half that belongs to us [J]
  VectorSum force; ///< of the plane on owned grains [N]
};

/// Candidates: gap to the image below (g_a + skin) S; bonded pairs always stay.
void rebuild_mirror(Mirror& mirror, const Particles& p, double g_a, double skin);

/// Bond each particle whose gap to its image is below limit S [m]; its spin keeps the y
/// part only.
void bond_to_mirror(Mirror& mirror, Particles& p, double limit);

/// Add the forces of the images over the step dt [s].
/// @throws NumericalError for a centre behind the plane
void add_mirror_forces(const PairMaterials& material, double dt, Particles& p,
                       Mirror& mirror, PairLosses& losses);

/// Drop the torque that would turn a bonded particle out of the plane's symmetry. Last of
/// all forces: a torque added later would spin a particle that the image holds, and feed
/// energy in.
void hold_mirror_spin(const Mirror& mirror, Particles& p);

} // namespace mergel::dem
