/// Triangles of a platen, and what their area gives.
#pragma once

#include "coupling/transfer.h"
#include "dem/walls/triangulated.h"

namespace mergel::coupling {

/// Surface of a platen. The axis points to the particles.
struct PlatenMesh {
  Nodal x; ///< [m]
  /// Indices into x; the normals (right-hand rule) point along the axis.
  std::vector<dem::Triangle> triangles;
  dem::Vec3 axis = dem::Vec3::UnitZ(); ///< unit
};

/// A flat disc as a polygon whose sides touch the circle from outside: it covers the disc.
/// @param centre, axis of the disc; the axis need not be of unit length
/// @param radius [m], > 0
/// @param n_around sides, >= 3
/// @throws InputError for a value out of range
PlatenMesh make_disc(const dem::Vec3& centre, const dem::Vec3& axis, double radius,
                     int n_around);

/// A flat rectangle with the edges 2 a and 2 b, which must be normal to each other; the
/// axis is that of a x b. @throws InputError for edges that are not
PlatenMesh make_rectangle(const dem::Vec3& centre, const dem::Vec3& a, const dem::Vec3& b);

/// Area of a surface, its centre, and int r r^T dA about the centre.
struct SurfaceMoments {
  dem::Vec3 area_vector = dem::Vec3::Zero();        ///< sum over the triangles [m^2]
  double area = 0.0;                                ///< [m^2]
  dem::Vec3 centre = dem::Vec3::Zero();             ///< [m]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero(); ///< [m^4]
};

SurfaceMoments moments_of(const PlatenMesh& mesh);

/// Two unit axes normal to this one and to each other.
Eigen::Matrix<double, 3, 2> normal_axes(const dem::Vec3& axis);

} // namespace mergel::coupling
