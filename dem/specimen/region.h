/// Region of a specimen: shape, size and boundaries.
#pragma once

#include "dem/particles/cell.h"

#include <variant>
#include <vector>

namespace mergel::dem {

/// Periodic box without walls, one corner at the origin.
struct PeriodicBox {
  Vec3 size = Vec3::Zero(); ///< edges [m]
};

/// Upright prism about the axis z, top at z = 0. Its side is made of `segments` equal
/// chords of a circle, like a triangulated wall.
struct Cylinder {
  double radius = 0.0; ///< of the circle through the corners [m]
  double height = 0.0; ///< [m]
  int segments = 0;    ///< chords around, at least 3
};

/// The half y >= 0 of such a prism, cut at the symmetry plane y = 0.
struct HalfCylinder {
  double radius = 0.0; ///< of the circle through the corners [m]
  double height = 0.0; ///< [m]
  int segments = 0;    ///< chords over the half circle, at least 2
};

using Region = std::variant<PeriodicBox, Cylinder, HalfCylinder>;

/// The face of a prism's side whose sector holds a point x.
struct Side {
  double clearance = 0.0;      ///< distance of x from the face, inside positive [m]
  Vec3 inwards = Vec3::Zero(); ///< unit normal of the face
};
Side side(const Cylinder& c, const Vec3& x);
Side side(const HalfCylinder& c, const Vec3& x);

/// Kind of a boundary.
enum class Boundary {
  wall, ///< solid: particles touch it
  cut   ///< mirror plane: the far-field shell of a particle touches that of its image there
};

/// Call visit(clearance [m], inward normal, Boundary) for the boundaries of the region,
/// seen from the point x. A side further than `reach` [m] may be left out.
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
/// Smallest distance of the chords from the axis [m].
double apothem(const Cylinder& c);
double apothem(const HalfCylinder& c);
/// Lower bound of the apothem [m], without a cosine: cos a >= 1 - a^2/2.
double apothem_bound(const Cylinder& c);
double apothem_bound(const HalfCylinder& c);
template <class Prism, class Visit>
void visit_side(const Prism& c, const Vec3& x, double reach, Visit&& visit)
{
  const double sure = apothem_bound(c) - reach; // enough for most points
  if (sure > 0.0 && x.x() * x.x() + x.y() * x.y() < sure * sure) return;
  const double free = apothem(c) - reach; // closer to the axis no chord is within reach
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

/// Whether depth(x) >= margin, margin > 0 [m]: faster than depth(), for many points.
inline bool is_inside_by(const PeriodicBox&, const Vec3&, double)
{
  return true;
}
template <class Prism>
bool is_inside_prism_by(const Prism& c, const Vec3& x, double margin)
{
  if (-x.z() < margin || x.z() + c.height < margin) return false;
  const double r2 = x.x() * x.x() + x.y() * x.y();
  // A chord is never further from the axis than the circle through its ends.
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

double volume(const Region& region);         ///< [m^3]
double smallest_width(const Region& region); ///< a sphere of this diameter just fits [m]
PeriodicCell cell_of(const Region& region);  ///< periodic for a PeriodicBox only
/// Distance of x from the axis z, or from the vertical centre line of a box [m].
double axis_distance(const Region& region, const Vec3& x);

/// Corners of the bounding box of a region [m].
struct Bounds {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
Bounds bounds(const Region& region);

/// Point of the bounding box with these relative coordinates, each in [0, 1].
Vec3 place(const Region& region, const Vec3& u);

/// A plane boundary and its unit normal into the region.
struct Face {
  Vec3 point = Vec3::Zero(), inwards = Vec3::UnitZ();
};
/// The solid faces of a region. A periodic box has none, and the cut of a half cylinder is
/// not one of them.
std::vector<Face> solid_faces(const Region& region);

/// @throws InputError for a region without extent, or a prism of too few chords
void check(const Region& region);

} // namespace mergel::dem
