/// Forces between particles: one kernel for all pairs, bonded or not.
#pragma once

#include "dem/laws/bond_step.h"
#include "dem/laws/contact_law.h"
#include "dem/math/exact_sum.h"
#include "dem/pairs/bonds.h"
#include "dem/pairs/contacts.h"

#include <concepts>

namespace mergel::dem {

/// Where a bond between particles broke, and under which load.
struct Breakage {
  Pair pair;
  Vec3 x = Vec3::Zero(); ///< half way between the centres [m]
  BreakMode mode = BreakMode::tension;
};

/// Energy lost by pairs and walls, and number of broken bonds. A pair counts on the rank
/// that owns its first particle.
struct PairLosses : BondLosses {
  EnergySum slip;                  ///< friction [J]
  std::vector<Breakage> breakages; ///< of bonds between particles, not sorted
  /// In a strain-controlled cell, diagonal of sum F (x) r of the last step [J]: volume
  /// times stress, tension positive.
  ExactVector<EnergySum> virial;
};

/// Show each exact sum that counts from the start of the run to `visit(name, kind, sum)`.
template <class Losses, class Visit>
requires std::same_as<std::remove_const_t<Losses>, PairLosses>
void visit_sums(Losses& losses, Visit&& visit)
{
  visit("slip", SumKind::by_rank, losses.slip);
  visit("plastic", SumKind::by_rank, losses.plastic);
  visit("breakage_release", SumKind::by_rank, losses.breakage_release);
}

/// The materials of a pair: of its bond and of its far-field contact.
struct PairMaterials {
  BondLaw bond;
  ContactLaw contact;
};

/// Add force and torque of all bonded pairs, or of all other contacts, to p.load, in
/// ascending order, and update their histories over the step dt [s] that ends now. A bond
/// that breaks lowers n_bonds of both particles.
void add_bond_forces(const PairMaterials& material, const PeriodicCell& cell, double dt,
                     Particles& p, Bonds& bonds, PairLosses& losses);
void add_contact_forces(const ContactLaw& contact, const PeriodicCell& cell, double dt,
                        Particles& p, Contacts& contacts, PairLosses& losses);

/// One far-field contact, for output and the energy balance.
struct ContactReading {
  double f_n;    ///< compression [N]; 0 when open
  double energy; ///< stored in both springs [J]
};

/// @param f_s shear force of the contact [N]
ContactReading read_contact(const Pair& pair, const Vec3& f_s, const Particles& p,
                            const PeriodicCell& cell, const ContactLaw& law);

/// Shear force of the contact of a bonded pair, on i [N].
Vec3 contact_shear_of(const Bonds& bonds, std::size_t b);

} // namespace mergel::dem
