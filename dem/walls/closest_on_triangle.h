/// The closest point of one triangle to a point.
#pragma once

#include "dem/walls/triangle.h"
#include "dem/walls/triangulated.h"

namespace mergel::dem {

/// Of a corner one weight is 1 and the others 0; of an edge one is 0.
struct ClosestPoint {
  Vec3 weight; ///< barycentric
  Vec3 point;
};

inline ClosestPoint closest_on_triangle(const Vec3& c, const Vec3& a, const Vec3& b,
                                        const Vec3& d)
{
  const TriangleRegions<double> r(triple(c), triple(a), triple(b), triple(d));
  if (r.at_corner_a()) return {{1, 0, 0}, a};
  if (r.at_corner_b()) return {{0, 1, 0}, b};
  if (r.at_corner_d()) return {{0, 0, 1}, d};
  if (r.at_edge_ab()) { // d1 - d3 = |ab|^2 > 0
    const double s = r.d1 / (r.d1 - r.d3);
    return {{1 - s, s, 0}, a + s * (b - a)};
  }
  if (r.at_edge_da()) { // d2 - d6 = |ad|^2 > 0
    const double s = r.d2 / (r.d2 - r.d6);
    return {{1 - s, 0, s}, a + s * (d - a)};
  }
  if (r.at_edge_bd()) { // the sum is |bd|^2 > 0
    const double s = (r.d4 - r.d3) / ((r.d4 - r.d3) + (r.d5 - r.d6));
    return {{0, 1 - s, s}, b + s * (d - b)};
  }
  const TrianglePoint<double> at = point_of_face(r);
  return {vec3(at.weight), vec3(at.x)};
}

} // namespace mergel::dem
