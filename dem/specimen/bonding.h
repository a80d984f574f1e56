/// Which particles of a specimen are bonded.
#pragma once

#include "dem/pairs/pairs.h"
#include "dem/specimen/packing.h"

namespace mergel::dem {

/// The bonds of a specimen and their largest gap.
struct Bonding {
  std::vector<Pair> pairs; ///< ascending
  double limit = 0.0;      ///< largest bonded gap/S [m]
};

/// Pairs in ascending gap/S, ties by id, until 2 N_bonds/N = coordination or the gap
/// exceeds g_b S.
Bonding choose_bonds(const SpecimenSpec& spec, const Particles& p,
                     const PeriodicCell& cell);

} // namespace mergel::dem
