/// Forces between particles: one kernel for every pair, bonded or not.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/pairs/bonds.h"
#include "dem/pairs/contacts.h"

#include <array>

namespace mergel::dem {

/// Where a bond between grains broke, and of what.
struct Breakage {
  Pair pair;
  Vec3 x = Vec3::Zero(); ///< half way between the centres [m]
  BreakMode mode = BreakMode::tension;
};

/// What pairs and walls dissipate and how many bonds break. A pair counts where its first
/// grain is owned.
struct PairLosses {
  EnergySum slip;    ///< friction [J]
  EnergySum plastic; ///< plasticity and damage of bonds [J]
  EnergySum residue; ///< still stored in bonds that broke [J]
  std::size_t broken = 0;
  std::size_t yielded = 0;         ///< bonds that yielded, summed over steps
  std::vector<Breakage> breakages; ///< of bonds between grains, in no order
  std::array<std::size_t, n_break_modes> broken_by{}; ///< of these, by mode
  /// In a driven cell, diagonal of sum F (x) r of the last step: volume times stress, tension
  /// positive [J].
  ExactVector<EnergySum> virial;
};

/// Both materials of a pair: of the bond and of the contact beside it.
struct PairMaterials {
  BondLaw bond;
  LinearMaterial contact;
};

/// Add force and torque of every bond, then of every contact, to p.load, each in ascending
/// order, and carry their histories over the step dt [s] that ends now. A bond that breaks
/// is counted down at both its particles.
void add_bond_forces(const PairMaterials& material, const PeriodicCell& cell, double dt,
                     Particles& p, Bonds& bonds, PairLosses& losses);
void add_contact_forces(const LinearMaterial& contact, const PeriodicCell& cell, double dt,
                        Particles& p, Contacts& contacts, PairLosses& losses);

/// One far-field contact as books and output see it.
struct ContactReading {
  double f_n;    ///< compression [N]; 0 when open
  double energy; ///< stored in both springs [J]
};

/// @param f_s shear force of the contact [N]
ContactReading read_contact(const Pair& pair, const Vec3& f_s, const Particles& p,
                            const PeriodicCell& cell, const LinearMaterial& material);

/// Shear force of the contact beside a bond [N].
Vec3 shear_beside(const Bonds& bonds, std::size_t b);

/// Elastic energy [J] of bonds, and of contacts with those beside the bonds; a pair counts
/// where its first grain is owned.
struct PairEnergy {
  EnergySum bonds, contacts;
};
PairEnergy pair_energy(const PairMaterials& material, const PeriodicCell& cell,
                       const Particles& p, const Bonds& bonds, const Contacts& contacts);

} // namespace mergel::dem
