/// The closest point of a triangle to a point, for one or one per lane.
#pragma once

#include "dem/math/simd.h"

namespace mergel::dem {

/// What decides on which feature of a triangle the closest point to c lies: the Voronoi
/// regions of Ericson (2005), Real-Time Collision Detection, section 5.1.5.
template <class Real>
struct TriangleRegions {
  Triple<Real> a, ab, ad, ac; ///< first corner, edges from it, c from it
  Real d1, d2;                ///< of c from the first corner, along ab and ad
  Real d3, d4;                ///< from the second
  Real d5, d6;                ///< from the third
  Real va, vb, vd;            ///< barycentric coordinates, not normalised

  [[gnu::always_inline]] TriangleRegions(const Triple<Real>& c, const Triple<Real>& first,
                                         const Triple<Real>& second,
                                         const Triple<Real>& third)
      : a(first), ab(second - first), ad(third - first), ac(c - first)
  {
    const Triple<Real> bc = c - second, dc = c - third;
    d1 = dot(ab, ac);
    d2 = dot(ad, ac);
    d3 = dot(ab, bc);
    d4 = dot(ad, bc);
    d5 = dot(ab, dc);
    d6 = dot(ad, dc);
    va = d3 * d6 - d5 * d4;
    vb = d5 * d2 - d1 * d6;
    vd = d1 * d4 - d3 * d2;
  }

  auto at_corner_a() const { return (d1 <= Real{}) & (d2 <= Real{}); }
  auto at_corner_b() const { return (d3 >= Real{}) & (d4 <= d3); }
  auto at_corner_d() const { return (d6 >= Real{}) & (d5 <= d6); }
  auto at_edge_ab() const { return (vd <= Real{}) & (d1 >= Real{}) & (d3 <= Real{}); }
  auto at_edge_da() const { return (vb <= Real{}) & (d2 >= Real{}) & (d6 <= Real{}); }
  auto at_edge_bd() const
  {
    return (va <= Real{}) & (d4 - d3 >= Real{}) & (d5 - d6 >= Real{});
  }
  /// The closest point is on the face, and not so near an edge that round-off decides on it.
  auto well_inside_face() const
  {
    const Real margin = 1e-9 * (va + vb + vd);
    return (va > margin) & (vb > margin) & (vd > margin);
  }

  /// c is on the side to which the normal ab x ad points.
  auto is_in_front() const { return dot(ac, cross(ab, ad)) > Real{}; }
};

/// A point of a triangle.
template <class Real>
struct TrianglePoint {
  Triple<Real> weight; ///< barycentric
  Triple<Real> x;
};

/// The closest point where it lies on the face.
template <class Real>
[[gnu::always_inline]] inline TrianglePoint<Real>
point_of_face(const TriangleRegions<Real>& r)
{
  const Real inv = 1.0 / (r.va + r.vb + r.vd); // twice the area squared, not 0
  const Real wb = r.vb * inv, wd = r.vd * inv;
  return {{1.0 - wb - wd, wb, wd}, r.a + r.ab * wb + r.ad * wd};
}

} // namespace mergel::dem
