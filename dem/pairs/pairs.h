/// Pairs of particles and their order, in which forces are summed.
#pragma once

#include "dem/particles/cell.h"

#include <compare>

namespace mergel::dem {

/// A pair, i < j. Lists of pairs ascend in (i, j, shift). Indices name the same particles
/// on all ranks, and ascend with the ids.
struct Pair {
  Index i, j;
  Shift shift{}; ///< periodic image of j

  auto operator<=>(const Pair&) const = default;
};

} // namespace mergel::dem
