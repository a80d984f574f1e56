/// History of one bond as a record, for messages between ranks and for checkpoints.
#pragma once

#include "dem/pairs/bonds.h"

#include <array>

namespace mergel::dem {

/// gap_0 [m], u_p [m], V [N], M [N m], T [N m], intact [-], and f_s [N] of the contact of
/// the pair: see BondBlock.
using BondHistory = std::array<double, 13>;

inline BondHistory history_of(const Bonds& bonds, std::size_t b)
{
  const BondBlock& k = bonds.blocks[b / n_lanes];
  const auto l = static_cast<int>(b % n_lanes);
  return {k.gap_0[l], k.u_p[l], k.V.x[l],    k.V.y[l],   k.V.z[l],   k.M.x[l],  k.M.y[l],
          k.M.z[l],   k.T[l],   k.intact[l], k.f_s.x[l], k.f_s.y[l], k.f_s.z[l]};
}

/// Append a bond; its pair must follow all others in order. A new block is padded as
/// broken.
inline void append(Bonds& bonds, const Pair& pair, const BondHistory& h)
{
  const auto l = static_cast<int>(bonds.size() % n_lanes);
  if (l == 0) bonds.blocks.push_back(BondBlock{});
  BondBlock& k = bonds.blocks.back();
  k.gap_0[l] = h[0];
  k.u_p[l] = h[1];
  set_lane(k.V, l, {h[2], h[3], h[4]});
  set_lane(k.M, l, {h[5], h[6], h[7]});
  k.T[l] = h[8];
  k.intact[l] = h[9];
  set_lane(k.f_s, l, {h[10], h[11], h[12]});
  bonds.pairs.push_back(pair);
}

} // namespace mergel::dem
