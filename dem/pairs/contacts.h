/// Pairs of the neighbour list that were never bonded, and the shear force of those in
/// contact.
#pragma once

#include "dem/pairs/pairs.h"

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
};

} // namespace mergel::dem
