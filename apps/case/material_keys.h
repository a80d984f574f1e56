/// The keys of bond and contact, common to all jobs.
#pragma once

#include "apps/case/law_keys.h"
#include "dem/pairs/forces.h"

namespace mergel::apps {

inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// The keys of each law, in the open section.
void declare_law(CaseFile& file, dem::DamageBond& bond);
void declare_law(CaseFile& file, dem::ParallelBond& bond);
void declare_law(CaseFile& file, dem::LinearMaterial& contact);
void declare_law(CaseFile& file, dem::HertzMaterial& contact);

/// Section "Bond": the keys of every bond law, of which `bond law` chooses one.
struct BondKeys {
  dem::BondSection section; ///< common to all laws, except the twist
  LawKeys<dem::BondLaw> law;

  /// The chosen law with all its parameters.
  dem::BondLaw chosen() const;
};

void declare(CaseFile& file, BondKeys& b);

/// Section "Contact": the keys of every contact law, of which `contact law` chooses one.
using ContactKeys = LawKeys<dem::ContactLaw>;

void declare(CaseFile& file, ContactKeys& contact);

/// The contact with a wall: that of the particles with another modulus and friction, and
/// without an activation gap.
dem::ContactLaw wall_contact(const dem::ContactLaw& particles, double E, double mu);

/// The parameters of a contact that a specimen under pressure depends on, as a recipe holds
/// them.
std::vector<std::pair<std::string, std::string>> recipe(const dem::ContactLaw& contact);

} // namespace mergel::apps
