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

inline NodeLanes load(const NodalMessage& field, Eigen::Index a)
{
  const double* const x = field.data() + 3 * a;
  return NodeLanes{x[0], x[1], x[2], 0.0};
}

inline void store(NodalMessage& field, Eigen::Index a, const NodeLanes& lanes)
{
  std::memcpy(field.data() + 3 * a, &lanes, 3 * sizeof(double));
}

/// Of x, y and z.
inline double sum(const NodeLanes& s)
{
  return (s[0] + s[1]) + s[2];
}

} // namespace mergel::fem
