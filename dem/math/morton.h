/// Position of a point on Morton's space-filling curve: particles numbered along it have
/// their neighbours near in memory. Source: Morton (1966), IBM technical report.
#pragma once

#include <cstdint>

namespace mergel::dem {

/// The bits of three numbers below 2^21, interleaved.
inline std::uint64_t morton(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  const auto spread = [](std::uint64_t a) {
    a = (a | a << 32) & 0x1f00000000ffffu;
    a = (a | a << 16) & 0x1f0000ff0000ffu;
    a = (a | a << 8) & 0x100f00f00f00f00fu;
    a = (a | a << 4) & 0x10c30c30c30c30c3u;
    return (a | a << 2) & 0x1249249249249249u;
  };
  return spread(x) | spread(y) << 1 | spread(z) << 2;
}

} // namespace mergel::dem
