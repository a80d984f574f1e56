/// Pairs of particles and the order in which they are summed.
#pragma once

#include "dem/particles/cell.h"

#include <compare>

namespace mergel::dem {

/// A pair, i < j; ascending in (i, j, shift) everywhere. Indices name the same particles on
/// every rank, and ascend with the ids.
struct Pair {
  Index i, j;
  Shift shift{}; ///< periodic image of j

  auto operator<=>(const Pair&) const = default;
};

} // namespace mergel::dem
