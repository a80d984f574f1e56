#include "dem/specimen/region.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

/// Visitor made of lambdas.
template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

double chord_angle(const Cylinder& c)
{
  return 2.0 * pi / c.segments;
}
double chord_angle(const HalfCylinder& c)
{
  return pi / c.segments;
}

/// Angle of x about the axis, from 0 to the sum of the chord angles.
double angle_of(const Cylinder&, const Vec3& x)
{
  const double phi = std::atan2(x.y(), x.x());
  return phi < 0.0 ? phi + 2.0 * pi : phi;
}
double angle_of(const HalfCylinder&, const Vec3& x)
{
  return std::clamp(std::atan2(x.y(), x.x()), 0.0, pi);
}

/// Outward direction of chord k.
double direction(double chord, int k)
{
  return (k + 0.5) * chord;
}

template <class Prism>
Side side_of(const Prism& c, const Vec3& x)
{
  const double chord = chord_angle(c);
  const int k = std::clamp(static_cast<int>(angle_of(c, x) / chord), 0, c.segments - 1);
  const double phi = direction(chord, k);
  const Vec3 inwards(-std::cos(phi), -std::sin(phi), 0.0);
  return {apothem(c) + x.dot(inwards), inwards};
}

template <class Prism>
double prism_volume(const Prism& c)
{
  return c.height * c.segments * 0.5 * c.radius * c.radius * std::sin(chord_angle(c));
}

template <class Prism>
std::vector<Face> prism_faces(const Prism& c)
{
  std::vector<Face> faces;
  for (int k = 0; k < c.segments; ++k) {
    const double phi = direction(chord_angle(c), k);
    const Vec3 outwards(std::cos(phi), std::sin(phi), 0.0);
    faces.push_back({apothem(c) * outwards, -outwards});
  }
  faces.push_back({Vec3::Zero(), -Vec3::UnitZ()});
  faces.push_back({{0.0, 0.0, -c.height}, Vec3::UnitZ()});
  return faces;
}

} // namespace

double apothem(const Cylinder& c)
{
  return c.radius * std::cos(0.5 * chord_angle(c));
}

double apothem(const HalfCylinder& c)
{
  return c.radius * std::cos(0.5 * chord_angle(c));
}

namespace {

template <class Prism>
double bound_of(const Prism& c)
{
  const double half = 0.5 * chord_angle(c);
  return c.radius * (1.0 - 0.5 * half * half) * (1.0 - 1e-12);
}

} // namespace

double apothem_bound(const Cylinder& c)
{
  return bound_of(c);
}
double apothem_bound(const HalfCylinder& c)
{
  return bound_of(c);
}

Side side(const Cylinder& c, const Vec3& x)
{
  return side_of(c, x);
}

Side side(const HalfCylinder& c, const Vec3& x)
{
  return side_of(c, x);
}

double depth(const Region& region, const Vec3& x)
{
  double smallest = std::numeric_limits<double>::infinity();
  const auto visit = [&smallest](double clearance, const Vec3&, Boundary) {
    smallest = std::min(smallest, clearance);
  };
  // The side last: it is the most expensive, and it counts only if nearer than the planes.
  std::visit(Cases{[](const PeriodicBox&) {},
                   [&](const Cylinder& c) {
                     visit_ends(c.height, x, visit);
                     visit_side(c, x, smallest, visit);
                   },
                   [&](const HalfCylinder& c) {
                     visit(x.y(), Vec3(Vec3::UnitY()), Boundary::cut);
                     visit_ends(c.height, x, visit);
                     visit_side(c, x, smallest, visit);
                   }},
             region);
  return smallest;
}

double volume(const Region& region)
{
  return std::visit(Cases{[](const PeriodicBox& b) { return b.size.prod(); },
                          [](const auto& prism) { return prism_volume(prism); }},
                    region);
}

double smallest_width(const Region& region)
{
  return std::visit(
      Cases{[](const PeriodicBox& b) { return b.size.minCoeff(); },
            [](const Cylinder& c) { return std::min(2.0 * c.radius, c.height); },
            [](const HalfCylinder& c) { return std::min(c.radius, c.height); }},
      region);
}

PeriodicCell cell_of(const Region& region)
{
  PeriodicCell cell;
  if (const auto* box = std::get_if<PeriodicBox>(&region)) cell.size = box->size;
  return cell;
}

double axis_distance(const Region& region, const Vec3& x)
{
  Vec3 axis = Vec3::Zero();
  if (const auto* box = std::get_if<PeriodicBox>(&region)) axis = 0.5 * box->size;
  return std::hypot(x.x() - axis.x(), x.y() - axis.y());
}

Bounds bounds(const Region& region)
{
  return std::visit(
      Cases{[](const PeriodicBox& b) {
              return Bounds{Vec3::Zero(), b.size};
            },
            [](const Cylinder& c) {
              return Bounds{{-c.radius, -c.radius, -c.height}, {c.radius, c.radius, 0.0}};
            },
            [](const HalfCylinder& c) {
              return Bounds{{-c.radius, 0.0, -c.height}, {c.radius, c.radius, 0.0}};
            }},
      region);
}

Vec3 place(const Region& region, const Vec3& u)
{
  return std::visit(
      Cases{[&](const PeriodicBox& b) { return Vec3(b.size.cwiseProduct(u)); },
            [&](const Cylinder& c) {
              return Vec3(c.radius * (2.0 * u.x() - 1.0), c.radius * (2.0 * u.y() - 1.0),
                          -c.height * u.z());
            },
            [&](const HalfCylinder& c) {
              return Vec3(c.radius * (2.0 * u.x() - 1.0), c.radius * u.y(),
                          -c.height * u.z());
            }},
      region);
}

std::vector<Face> solid_faces(const Region& region)
{
  return std::visit(Cases{[](const PeriodicBox&) { return std::vector<Face>(); },
                          [](const auto& prism) { return prism_faces(prism); }},
                    region);
}

void check(const Region& region)
{
  std::visit(Cases{[](const PeriodicBox& b) {
                     require((b.size.array() > 0.0).all(),
                             "the three edges of the periodic box must be positive");
                   },
                   [](const Cylinder& c) {
                     require(c.radius > 0.0 && c.height > 0.0 && c.segments > 2,
                             "the cylinder needs a positive radius and height and at least "
                             "three chords");
                   },
                   [](const HalfCylinder& c) {
                     require(c.radius > 0.0 && c.height > 0.0 && c.segments > 1,
                             "the half cylinder needs a positive radius and height and "
                             "at least two chords");
                   }},
             region);
}

} // namespace mergel::dem
