/// Counter-based random numbers: a number depends on seed, id and purpose only, not on the
/// order of calls.
#pragma once

#include <cstdint>

namespace mergel::dem {

/// Uniform in [0, 1), 53 bits. Each (seed, id, draw) gives an independent number. Source:
/// the finaliser of Steele, Lea and Flood (2014), Fast splittable pseudorandom number
/// generators.
/// @param draw number of the purpose
inline double uniform(std::uint64_t seed, std::uint64_t id, std::uint64_t draw)
{
  const auto mix = [](std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  const std::uint64_t golden = 0x9e3779b97f4a7c15u;
  const std::uint64_t z = mix(mix(mix(seed + golden) + id * golden) + (draw + 1) * golden);
  return static_cast<double>(z >> 11) * 0x1p-53;
}

} // namespace mergel::dem
