/// Pairs of particles and the order in which they are summed.
#pragma once

#include "dem/cell.h"

#include <compare>

namespace mergel::dem {

/// A pair, i < j by global id; ascending in (i, j, shift) everywhere. Particles ascend by
/// id within the owned range, so on one rank local indices order pairs as ids do.
struct Pair {
  Index i, j;
  Shift shift{}; ///< periodic image of j

  auto operator<=>(const Pair&) const = default;
};

} // namespace mergel::dem
