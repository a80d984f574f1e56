/// Nodal vectors inside fem/: four doubles per node, so that a node is one SIMD register.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace mergel::fem {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// One column per node: x, y, z and a fourth entry that is always zero.
using NodalField = Eigen::Array<double, 4, Eigen::Dynamic>;

/// The same without the fourth entry, as ranks send it.
using NodalMessage = Eigen::Array<double, 3, Eigen::Dynamic>;

/// Two points of a mesh coincide, or one lies on a plane, within this share of the size of the
/// mesh [-].
inline constexpr double coincidence = 1e-9;

/// The four entries of one node as a SIMD vector.
using NodeLanes [[gnu::vector_size(32)]] = double;

/// The vector of node a.
inline Vec3 at(const NodalField& field, Eigen::Index a)
{
  return field.col(a).head<3>().matrix();
}

inline Vec3 at(const NodalMessage& field, Eigen::Index a)
{
  return field.col(a).matrix();
}

/// Sum of a.b over all nodes.
inline double dot(const NodalField& a, const NodalField& b)
{
  return (a * b).sum();
}

} // namespace mergel::fem
