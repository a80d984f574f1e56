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
  std::vector<Index> close; ///< numbers of the pairs that may act (VerletList::narrow())
  bool is_narrowed = false; ///< whether they were chosen; otherwise any pair may act
};

/// Write the numbers of the pairs whose gap is below `range` S, or that still have a shear
/// force, to `which`, ascending. Examines the close pairs alone where the list is narrowed.
/// @param range at S = 1 [m]; @param extra range of each particle [m]; empty: none
void choose_contacts(double range, const PeriodicCell& cell, const Particles& p,
                     const Contacts& contacts, std::vector<Index>& which,
                     const std::vector<double>& extra = {});

} // namespace mergel::dem
