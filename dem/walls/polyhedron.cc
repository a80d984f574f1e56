#include "dem/walls/polyhedron.h"

#include "dem/error.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

[[noreturn]] void refuse_inside()
{
  throw NumericalError("its centre is inside a rigid wall; the contact of the wall is too "
                       "soft or the time step too long");
}

/// The closest point of the surface as a feature.
PatchFeature feature_of(const NearestOnSurface& closest, const Vec3& c)
{
  using On = PatchFeature::On;
  PatchFeature f{On::face,         0,   closest.at, closest.point, Vec3::Zero(),
                 closest.distance, 0.0, 1.0};
  if (closest.distance > 0.0) f.n = (closest.point - c) / closest.distance;
  const Vec3& weight = closest.at.weight;
  const auto n_zero = (weight.array() == 0.0).count();
  if (n_zero == 2) {
    f.on = On::corner;
    weight.maxCoeff(&f.which);
  } else if (n_zero == 1) {
    f.on = On::edge;
    int opposite = 0;
    weight.cwiseAbs().minCoeff(&opposite);
    f.which = (opposite + 1) % 3;
  }
  return f;
}

} // namespace

bool Polyhedron::is_beyond(const ParticleState& b, const Vec3& x, double gap) const
{
  const Vec3 r = b.x - x;
  const double reach = b.R + gap, around = R_outside + reach;
  return r.x() * r.x() + r.y() * r.y() > around * around || -r.z() > reach ||
         r.z() > length + reach;
}

SurfacePoint Polyhedron::closest_point(const ParticleState& b, const Vec3& x) const
{
  const Vec3 c = b.x - x;
  const auto closest = search.nearest(surface.x, surface.topology.triangles, c,
                                      std::numeric_limits<double>::infinity());
  if (!closest) throw NumericalError("its centre is not a number");
  const PatchFeature f = feature_of(*closest, c);
  if (!(f.distance > 0.0))
    throw NumericalError("its centre lies on the surface of a rigid wall");
  if (!is_in_front(surface, f)) refuse_inside();
  return {f.n, f.distance - b.R, x + f.point, part_at(f.point)};
}

Polyhedron make_polyhedron(ClosedSurface s)
{
  require_closed(s);
  double low = s.x.front().z();
  for (const Vec3& x : s.x) low = std::min(low, x.z());
  Polyhedron polyhedron;
  for (Vec3& x : s.x) {
    x.z() -= low;
    polyhedron.length = std::max(polyhedron.length, x.z());
    polyhedron.R_outside = std::max(polyhedron.R_outside, std::hypot(x.x(), x.y()));
  }
  polyhedron.sections = cross_sections(s);
  polyhedron.tip_height = largest(polyhedron.sections).z;
  polyhedron.search = SurfaceSearch(s.x, s.triangles);
  polyhedron.surface.topology = make_topology(s.x, std::move(s.triangles), any_fold);
  polyhedron.surface.x = std::move(s.x);
  polyhedron.surface.v.assign(polyhedron.surface.x.size(), Vec3::Zero());
  return polyhedron;
}

void require_symmetric(const Polyhedron& polyhedron, double tolerance)
{
  for (const Vec3& x : polyhedron.surface.x) {
    const Vec3 image(x.x(), -x.y(), x.z());
    if (polyhedron.search.nearest(polyhedron.surface.x,
                                  polyhedron.surface.topology.triangles, image, tolerance))
      continue;
    throw InputError(
        "is not symmetric about the plane y = 0: the mirror image of the point (" +
        shortest(x.x()) + ", " + shortest(x.y()) + ", " + shortest(x.z()) +
        ") m, counted from the lowest point, is more than " + shortest(tolerance) +
        " m from the surface. Turn or move the polyhedron, or "
        "make the full model");
  }
}

PolyhedronFeatures::PolyhedronFeatures(const Polyhedron& polyhedron)
    : polyhedron_(polyhedron), numbers_(polyhedron.surface.topology)
{
}

const std::vector<PatchFeature>& PolyhedronFeatures::find(const Vec3& x, double reach)
{
  found_.clear();
  polyhedron_.search.within(x, reach, triangles_);
  if (triangles_.empty()) return found_;
  near_.clear();
  for (const int t : triangles_) near_.push_back({.triangle = t, .clearance = 0.0});
  ListedCandidate candidate;
  numbers_.number(candidate, near_);
  features_.find_within(polyhedron_.surface, candidate, near_, x, reach);
  if (features_.found().empty()) return found_;
  if (!is_in_front(polyhedron_.surface, features_.nearest())) refuse_inside();
  for (const PatchFeature& f : features_.found())
    if (is_in_front(polyhedron_.surface, f)) found_.push_back(f);
  return found_;
}

} // namespace mergel::dem
