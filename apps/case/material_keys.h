/// The keys of bond and contact, common to all jobs.
#pragma once

#include "apps/case/case_file.h"
#include "dem/pairs/forces.h"

namespace mergel::apps {

inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// Section "Bond": the keys of every bond law, of which `bond law` chooses one.
struct BondKeys {
  enum class Law { damage, parallel };

  Law law = Law::damage;
  dem::BondSection section; ///< common to all laws, except the twist
  dem::DamageBond damage;
  dem::ParallelBond parallel;

  /// The chosen law with all its parameters.
  dem::BondLaw chosen() const;
};

void declare(CaseFile& file, BondKeys& b);

/// Section "Contact": the far-field contact between particles.
void declare(CaseFile& file, dem::LinearMaterial& contact);

} // namespace mergel::apps
