/// Nodal vectors as fem/ stores them inside: four doubles a node, so that a node is one
/// SIMD word.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace mergel::fem {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// One column per node: x, y, z and a fourth entry that is always zero.
using Nodal = Eigen::Array<double, 4, Eigen::Dynamic>;

/// The four entries of one node as a vector of the processor.
using Lanes [[gnu::vector_size(32)]] = double;

/// The vector of node a.
inline Vec3 at(const Nodal& field, Eigen::Index a)
{
  return field.col(a).head<3>().matrix();
}

/// Sum of a.b over all nodes.
inline double dot(const Nodal& a, const Nodal& b)
{
  return (a * b).sum();
}

} // namespace mergel::fem
