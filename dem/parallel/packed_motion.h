/// Position, velocity and spin of a particle, packed for messages.
#pragma once

#include "dem/particles/particles.h"

#include <array>

namespace mergel::dem {

using PackedMotion = std::array<double, 9>;

inline PackedMotion pack(const ParticleState& b)
{
  return {b.x[0], b.x[1],     b.x[2],     b.v[0],    b.v[1],
          b.v[2], b.omega[0], b.omega[1], b.omega[2]};
}

inline void unpack(const PackedMotion& from, ParticleState& b)
{
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    b.x[a] = from[k];
    b.v[a] = from[3 + k];
    b.omega[a] = from[6 + k];
  }
}

} // namespace mergel::dem
