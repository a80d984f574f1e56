/// Pairs of the neighbour list that were never bonded, and the shear force of those in
/// contact.
#pragma once

#include "dem/pairs/pairs.h"
#include "dem/particles/particles.h"

#include <vector>

namespace mergel::dem {

/// Shear force of one contact on i [N], padded to one row of four.
struct alignas(32) ContactShear {
  Vec3 f_s = Vec3::Zero();
  double pad = 0.0;
};

struct Contacts {
  std::vector<Pair> pairs; ///< ascending
  std::vector<ContactShear> shear;
  /// Numbers of the pairs that may act until the list is narrowed again, where it is.
  std::vector<Index> close;
  bool is_narrowed = false; ///< otherwise any pair may act (VerletList::narrow())
};

/// Write the numbers of the pairs whose gap is below `range` S, or that still have a shear
/// force, to `which`, ascending. Examines the close pairs alone where the list is narrowed.
/// @param range at S = 1 [m]; @param extra range of each particle [m]; empty: none
void choose_contacts(double range, const PeriodicCell& cell, const Particles& p,
                     const Contacts& contacts, std::vector<Index>& which,
                     const std::vector<double>& extra = {});

} // namespace mergel::dem
