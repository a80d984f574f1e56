/// A node of a nodal field as one SIMD vector: to read, to write, and its sum.
#pragma once

#include "fem/nodal.h"

#include <cstring>

namespace mergel::fem {

inline NodeLanes load(const NodalField& field, Eigen::Index a)
{
  NodeLanes lanes;
  std::memcpy(&lanes, field.data() + 4 * a, sizeof lanes);
  return lanes;
}

inline void store(NodalField& field, Eigen::Index a, const NodeLanes& lanes)
{
  std::memcpy(field.data() + 4 * a, &lanes, sizeof lanes);
}

/// Of x, y and z.
inline double sum(const NodeLanes& s)
{
  return (s[0] + s[1]) + s[2];
}

} // namespace mergel::fem
