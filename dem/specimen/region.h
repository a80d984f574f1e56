/// Where a specimen is made: its shape, its size and what bounds it.
#pragma once

#include "dem/particles/cell.h"

#include <variant>
#include <vector>

namespace mergel::dem {

/// Box that goes on beyond its faces: no wall anywhere, one corner at the origin.
struct PeriodicBox {
  Vec3 size = Vec3::Zero(); ///< edges [m]
};

/// Upright prism about the axis z, top at z = 0, whose side is `segments` equal chords of a
/// circle, as the triangles of a wall make it.
struct Cylinder {
  double radius = 0.0; ///< of the circle through the corners [m]
  double height = 0.0; ///< [m]
  int segments = 0;    ///< chords around, at least 3
};

/// The half y >= 0 of such a prism, cut at y = 0, where the model goes on as its mirror image.
struct HalfCylinder {
  double radius = 0.0; ///< of the circle through the corners [m]
  double height = 0.0; ///< [m]
  int segments = 0;    ///< chords over the half circle, at least 2
};

using Region = std::variant<PeriodicBox, Cylinder, HalfCylinder>;

/// The side of a prism as a point inside sees it.
struct Side {
  double clearance = 0.0;      ///< to the chord whose sector x lies in, inside positive [m]
  Vec3 inwards = Vec3::Zero(); ///< its unit normal
};
Side side(const Cylinder& c, const Vec3& x);
Side side(const HalfCylinder& c, const Vec3& x);

/// What stands at a boundary.
enum class Boundary {
  wall, ///< a solid: spheres touch it
  cut   ///< a mirror plane: half of a sphere's far-field shell lies on each side
};

/// Visit what bounds the region, as seen from x: visit(clearance [m], inward normal,
/// Boundary). Of the side only what is closer than `reach` [m] need be visited.
template <class Visit>
void visit_boundaries(const PeriodicBox&, const Vec3&, double, Visit&&)
{
}
template <class Visit>
void visit_ends(double height, const Vec3& x, Visit&& visit)
{
  visit(-x.z(), Vec3(-Vec3::UnitZ()), Boundary::wall);
  visit(x.z() + height, Vec3(Vec3::UnitZ()), Boundary::wall);
}
/// Least distance of the side's chords from the axis [m].
double apothem(const Cylinder& c);
double apothem(const HalfCylinder& c);
/// The same from below, without a cosine: cos a >= 1 - a^2/2.
double apothem_bound(const Cylinder& c);
double apothem_bound(const HalfCylinder& c);
template <class Prism, class Visit>
void visit_side(const Prism& c, const Vec3& x, double reach, Visit&& visit)
{
  const double sure = apothem_bound(c) - reach; // most places end here
  if (sure > 0.0 && x.x() * x.x() + x.y() * x.y() < sure * sure) return;
  const double free = apothem(c) - reach; // nearer to the axis the side is out of reach
  if (free > 0.0 && x.x() * x.x() + x.y() * x.y() < free * free) return;
  const Side s = side(c, x);
  visit(s.clearance, s.inwards, Boundary::wall);
}
template <class Visit>
void visit_boundaries(const Cylinder& c, const Vec3& x, double reach, Visit&& visit)
{
  visit_side(c, x, reach, visit);
  visit_ends(c.height, x, visit);
}
template <class Visit>
void visit_boundaries(const HalfCylinder& c, const Vec3& x, double reach, Visit&& visit)
{
  visit_side(c, x, reach, visit);
  visit(x.y(), Vec3(Vec3::UnitY()), Boundary::cut);
  visit_ends(c.height, x, visit);
}

/// Distance to the nearest boundary, inside positive; infinite in a periodic box [m].
double depth(const Region& region, const Vec3& x);

/// Whether x is `margin` [m], > 0, away from every boundary, or further: depth(x) >= margin,
/// for many points.
inline bool is_inside_by(const PeriodicBox&, const Vec3&, double)
{
  return true;
}
template <class Prism>
bool is_inside_prism_by(const Prism& c, const Vec3& x, double margin)
{
  if (-x.z() < margin || x.z() + c.height < margin) return false;
  const double r2 = x.x() * x.x() + x.y() * x.y();
  // A chord is never further off than the circle through its ends.
  const double most = c.radius - margin, sure = apothem_bound(c) - margin;
  if (most < 0.0 || r2 > most * most) return false;
  if (sure > 0.0 && r2 < sure * sure) return true;
  return side(c, x).clearance >= margin;
}
inline bool is_inside_by(const Cylinder& c, const Vec3& x, double margin)
{
  return is_inside_prism_by(c, x, margin);
}
inline bool is_inside_by(const HalfCylinder& c, const Vec3& x, double margin)
{
  return x.y() >= margin && is_inside_prism_by(c, x, margin);
}

double volume(const Region& region);        ///< [m^3]
double least_width(const Region& region);   ///< a sphere of this diameter just fits [m]
PeriodicCell cell_of(const Region& region); ///< not periodic but for the box
double axis_distance(const Region& region,
                     const Vec3& x); ///< from z, or the box's mid line [m]

/// Corners of the box around the region.
struct Bounds {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
Bounds bounds(const Region& region);

/// The point of the box around the region that has these coordinates, each in [0, 1].
Vec3 place(const Region& region, const Vec3& u);

/// A boundary that is a plane.
struct Face {
  Vec3 point = Vec3::Zero(), inwards = Vec3::UnitZ();
};
/// Solid faces: the region is what all of them leave inside. None of a periodic box; the cut
/// is none.
std::vector<Face> solid_faces(const Region& region);

/// @throws InputError for a region without extent, or a prism of too few chords
void check(const Region& region);

} // namespace mergel::dem
