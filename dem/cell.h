/// Periodic cell: the offsets between a particle and its images.
#pragma once

#include "dem/notation.h"

#include <array>

namespace mergel::dem {

/// Integer periodic shift of the second particle of a pair, part of the pair's key.
using Shift = std::array<std::int16_t, 3>;

/// Box of edges `size`; an edge of 0 is not periodic. Positions are never wrapped: the
/// image of x under a shift is x + offset(shift).
struct PeriodicCell {
  Vec3 size = Vec3::Zero(); ///< [m]

  bool is_periodic() const { return size.any(); }
  Vec3 offset(const Shift& s) const
  {
    return {s[0] * size.x(), s[1] * size.y(), s[2] * size.z()};
  }
};

} // namespace mergel::dem
