#include "coupling/platen_mesh.h"

#include "dem/text.h"

#include <Eigen/Geometry>

#include <cmath>

namespace mergel::coupling {

using dem::uz;
using dem::Vec3;

PlatenMesh make_disc(const Vec3& centre, const Vec3& axis, double radius, int n_around)
{
  require(radius > 0.0 && std::isfinite(radius),
          "platen: radius = " + dem::shortest(radius) + ": must be > 0, in m");
  require(n_around >= 3,
          "platen: number of sides = " + std::to_string(n_around) + ": must be 3 or more");
  PlatenMesh mesh;
  mesh.axis = axis.normalized();
  const auto e = normal_axes(mesh.axis);
  const double r_corner = radius / std::cos(dem::pi / n_around);
  mesh.x.push_back(centre);
  for (int k = 0; k < n_around; ++k) {
    const double angle = 2.0 * dem::pi * k / n_around;
    mesh.x.push_back(centre + r_corner * (std::cos(angle) * Vec3(e.col(0)) +
                                          std::sin(angle) * Vec3(e.col(1))));
    mesh.triangles.push_back({0, k + 1, (k + 1) % n_around + 1});
  }
  return mesh;
}

PlatenMesh make_rectangle(const Vec3& centre, const Vec3& a, const Vec3& b)
{
  const Vec3 normal = a.cross(b);
  require(normal.norm() > 0.0 && std::abs(a.dot(b)) <= 1e-9 * a.norm() * b.norm(),
          "platen: the half edges of a rectangle must be normal to each other, and "
          "neither may be zero");
  PlatenMesh mesh;
  mesh.axis = normal.normalized();
  mesh.x = {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

SurfaceMoments moments_of(const PlatenMesh& mesh)
{
  SurfaceMoments s;
  const auto area_vector = [&](const dem::Triangle& t) {
    const Vec3& a = mesh.x[uz(t[0])];
    return Vec3(0.5 * (mesh.x[uz(t[1])] - a).cross(mesh.x[uz(t[2])] - a));
  };
  for (const dem::Triangle& t : mesh.triangles) {
    const Vec3 a = area_vector(t);
    s.area_vector += a;
    s.area += a.norm();
    for (const int k : t) s.centre += a.norm() / 3.0 * mesh.x[uz(k)];
  }
  if (s.area > 0.0) s.centre /= s.area;
  // Linear shape functions: int N_i N_j dA = A/12 (1 + delta_ij).
  for (const dem::Triangle& t : mesh.triangles) {
    Vec3 sum = Vec3::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (const int k : t) {
      const Vec3 r = mesh.x[uz(k)] - s.centre;
      sum += r;
      squares += r * r.transpose();
    }
    s.second += area_vector(t).norm() / 12.0 * (squares + sum * sum.transpose());
  }
  return s;
}

Eigen::Matrix<double, 3, 2> normal_axes(const Vec3& axis)
{
  Eigen::Matrix<double, 3, 2> e;
  e.col(0) = axis.unitOrthogonal();
  e.col(1) = axis.cross(Vec3(e.col(0)));
  return e;
}

} // namespace mergel::coupling
