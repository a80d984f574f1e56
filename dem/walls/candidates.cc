/// Candidates of a triangulated wall, their contact with its patches, and new wall bonds.
#include "dem/walls/triangle.h"
#include "dem/walls/triangulated.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mergel::dem {

namespace {

/// Closest point of a triangle, and the feature that it is on.
struct ClosestFeature {
  enum class On { face, edge, corner } on;
  int which;   ///< edge (k, k+1) or corner k
  Vec3 weight; ///< barycentric
  Vec3 point;
};

ClosestFeature closest_on_triangle(const Vec3& c, const Vec3& a, const Vec3& b,
                                   const Vec3& d)
{
  using On = ClosestFeature::On;
  const TriangleRegions<double> r(triple(c), triple(a), triple(b), triple(d));
  if (r.at_corner_a()) return {On::corner, 0, {1, 0, 0}, a};
  if (r.at_corner_b()) return {On::corner, 1, {0, 1, 0}, b};
  if (r.at_corner_d()) return {On::corner, 2, {0, 0, 1}, d};
  if (r.at_edge_ab()) { // d1 - d3 = |ab|^2 > 0
    const double s = r.d1 / (r.d1 - r.d3);
    return {On::edge, 0, {1 - s, s, 0}, a + s * (b - a)};
  }
  if (r.at_edge_da()) { // d2 - d6 = |ad|^2 > 0
    const double s = r.d2 / (r.d2 - r.d6);
    return {On::edge, 2, {1 - s, 0, s}, a + s * (d - a)};
  }
  if (r.at_edge_bd()) { // the sum is |bd|^2 > 0
    const double s = (r.d4 - r.d3) / ((r.d4 - r.d3) + (r.d5 - r.d6));
    return {On::edge, 1, {0, 1 - s, s}, b + s * (d - b)};
  }
  const TrianglePoint<double> at = point_of_face(r);
  return {On::face, 0, vec3(at.weight), vec3(at.x)};
}

ClosestFeature closest_on(const Wall& wall, int t, const Vec3& c)
{
  const Triangle& k = wall.topology.triangles[uz(t)];
  return closest_on_triangle(c, wall.x[uz(k[0])], wall.x[uz(k[1])], wall.x[uz(k[2])]);
}

/// As the lanes of a batch compute it.
double distance(const Vec3& from, const Vec3& to)
{
  const Triple<double> r = triple(to) - triple(from);
  return sqrt(dot(r, r));
}

/// True when the Voronoi region of the feature contains c on all triangles that share it. A
/// shared feature is reported once, by the first of its triangles.
bool is_reported(const Wall& wall, int t, const ClosestFeature& at, const Vec3& c)
{
  const WallTopology& topo = wall.topology;
  if (at.on == ClosestFeature::On::face) return true;
  const Triangle& tri = topo.triangles[uz(t)];
  if (at.on == ClosestFeature::On::edge) {
    const int other = topo.across[uz(t)][uz(at.which)];
    if (other < 0) return true;
    if (other < t) return false;
    const Vec3 e = wall.x[uz(tri[uz((at.which + 1) % 3)])] - wall.x[uz(tri[uz(at.which)])];
    // The other triangle has the edge in the opposite direction: e x normal points into it.
    return (c - at.point).dot(e.cross(normal(wall, other))) <= 0.0;
  }
  const int node = tri[uz(at.which)];
  for (const int other : topo.around[uz(node)]) {
    if (topo.patch[uz(other)] != topo.patch[uz(t)]) continue;
    if (other < t) return false;
    for (const int m : topo.triangles[uz(other)])
      if (m != node && (c - at.point).dot(wall.x[uz(m)] - wall.x[uz(node)]) > 0.0)
        return false;
  }
  return true;
}

Vec3 closest_point_of_wall(const Wall& wall, const std::vector<int>& triangles,
                           const Vec3& c, Anchor& anchor)
{
  double best = std::numeric_limits<double>::infinity();
  Vec3 point = Vec3::Zero();
  for (const int t : triangles) {
    const ClosestFeature at = closest_on(wall, t, c);
    const double d2 = (c - at.point).squaredNorm();
    if (d2 >= best) continue;
    best = d2;
    point = at.point;
    anchor = {t, at.weight};
  }
  return point;
}

/// How much nearer c is to the face than to the valleys (concave folds) at its edges [m];
/// infinite without a valley. It limits the overlap of the face, so that the force is
/// continuous where a second face enters the contact.
double distance_lead_over_valleys(const Wall& wall, int t, const Vec3& c, double distance)
{
  const WallTopology& topo = wall.topology;
  const Triangle& tri = topo.triangles[uz(t)];
  double lead = std::numeric_limits<double>::infinity();
  for (int e = 0; e < 3; ++e) {
    const int other = topo.across[uz(t)][uz(e)];
    if (other < 0) continue;
    const Vec3 &a = wall.x[uz(tri[uz(e)])], &b = wall.x[uz(tri[uz((e + 1) % 3)])];
    const Vec3 ab = b - a;
    const bool is_valley = ab.dot(normal(wall, t).cross(normal(wall, other))) < 0.0;
    if (!is_valley) continue;
    const double s = std::clamp((c - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    lead = std::min(lead, (c - a - s * ab).norm() - distance);
  }
  return lead;
}

} // namespace

std::optional<PatchContact> patch_contact(const Wall& wall,
                                          const ListedCandidate& candidate,
                                          const ParticleState& particle, double wall_travel)
{
  struct Feature {
    Anchor at;
    ClosestFeature::On on;
    Vec3 point;
    double distance, overlap;
  };
  std::array<Feature, PatchContact::max_features> features;
  std::size_t n_features = 0;
  double nearest = std::numeric_limits<double>::infinity();
  bool is_inside = true;
  Feature closest{};
  const double reach = activation_gap(wall.material) * particle.S;
  const double moved = candidate.motion(particle, wall_travel);
  for (const auto& [t, clearance] : wall.near_triangles(candidate)) {
    if (clearance > moved) continue;
    const Vec3& corner = wall.x[uz(wall.topology.triangles[uz(t)][0])];
    const double height = (particle.x - corner).dot(normal(wall, t));
    // A bound of the distance to the triangle, with a margin for its round-off.
    if (height - particle.R >= reach + 1e-6 * particle.R) continue;
    const ClosestFeature at = closest_on(wall, t, particle.x);
    const double d = distance(particle.x, at.point);
    const Feature feature{{t, at.weight}, at.on, at.point, d, reach - (d - particle.R)};
    if (d < nearest) {
      nearest = d;
      closest = feature;
      // At a boundary edge of the wall there is no wrong side.
      const bool has_sides = at.on == ClosestFeature::On::face ||
                             (at.on == ClosestFeature::On::edge &&
                              wall.topology.across[uz(t)][uz(at.which)] >= 0);
      is_inside = !has_sides || height > 0.0;
    }
    if (feature.overlap <= 0.0 || !is_reported(wall, t, at, particle.x)) continue;
    if (n_features == features.size())
      throw NumericalError(
          "it touches more than " + std::to_string(features.size()) +
          " faces, edges and corners of a wall: the triangles of the wall are too small "
          "for the particles");
    features[n_features++] = feature;
  }
  // Only what is in contact is judged: which other triangles were examined depends on the
  // list. No centre gets past a wall without a contact before.
  if (!is_inside && closest.overlap > 0.0)
    throw NumericalError("its centre is on the wrong side of a wall");

  double total = 0.0;
  for (std::size_t k = 0; k < n_features; ++k) {
    Feature& f = features[k];
    if (f.on == ClosestFeature::On::face && n_features > 1)
      f.overlap = std::min(
          f.overlap, std::max(0.0, distance_lead_over_valleys(wall, f.at.triangle,
                                                              particle.x, f.distance)));
    total += f.overlap;
  }
  // Above an edge, round-off may leave the centre in no Voronoi region: take the closest
  // feature.
  if (total <= 0.0 && closest.overlap > 0.0) {
    features[0] = closest;
    n_features = 1;
    total = closest.overlap;
  }
  if (n_features == 0) return std::nullopt;

  PatchContact p;
  if (n_features == 1) { // the same bits as a batch of faces gives
    const Feature& only = features[0];
    p.shares[p.n++] = {only.at, 1.0};
    p.geometry = {(only.point - particle.x) * (1.0 / only.distance),
                  only.distance - particle.R, only.point,
                  at(wall.v, wall.topology, only.at)};
    return p;
  }
  double mean_distance = 0.0;
  for (std::size_t k = 0; k < n_features; ++k) {
    const double w = features[k].overlap / total; // overlaps are positive
    p.shares[p.n++] = {features[k].at, w};
    p.geometry.point += w * features[k].point;
    p.geometry.v += w * at(wall.v, wall.topology, features[k].at);
    p.geometry.n += w * (features[k].point - particle.x) / features[k].distance;
    mean_distance += w * features[k].distance;
  }
  p.geometry.n.normalize();
  p.geometry.gap = mean_distance - particle.R;
  return p;
}

std::optional<NearestPoint> nearest_point(const Wall& wall,
                                          const ListedCandidate& candidate, const Vec3& x,
                                          double reach)
{
  std::optional<NearestPoint> nearest;
  for (const auto& near : wall.near_triangles(candidate)) {
    const Vec3& corner = wall.x[uz(wall.topology.triangles[uz(near.triangle)][0])];
    if ((x - corner).dot(normal(wall, near.triangle)) > reach) continue; // of its plane
    const ClosestFeature at = closest_on(wall, near.triangle, x);
    const double d = (x - at.point).norm();
    if (d > reach || (nearest && d >= nearest->distance)) continue;
    nearest = {{near.triangle, at.weight}, at.point, d};
  }
  return nearest;
}

void rebuild_wall(Wall& wall, const PairMaterials&, const Particles& p, double skin,
                  const std::vector<double>& extra)
{
  std::vector<WallContact> found;
  std::vector<ListedCandidate> listed;
  std::vector<NearTriangle> near;
  const WallTopology& topo = wall.topology;

  // Bounding spheres of the triangles, sorted along z: a particle tests only those at its
  // height.
  struct BoundingSphere {
    double z, r;
    Vec3 c;
    int t;
  };
  std::vector<BoundingSphere> balls;
  double r_max = 0.0;
  for (std::size_t t = 0; t < topo.triangles.size(); ++t) {
    const Triangle& k = topo.triangles[t];
    const Vec3 c = (wall.x[uz(k[0])] + wall.x[uz(k[1])] + wall.x[uz(k[2])]) / 3.0;
    double r = 0.0;
    for (const int m : k) r = std::max(r, (wall.x[uz(m)] - c).norm());
    balls.push_back({c.z(), r, c, static_cast<int>(t)});
    r_max = std::max(r_max, r);
  }
  std::sort(balls.begin(), balls.end(),
            [](const BoundingSphere& a, const BoundingSphere& b) {
              return std::pair{a.z, a.t} < std::pair{b.z, b.t};
            });

  struct Hit {
    int patch, triangle;
    double distance2;
  };
  std::vector<Hit> hits;
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    const double reach = b.R + (activation_gap(wall.material) + skin) * b.S +
                         (extra.empty() ? 0.0 : extra[i]);
    hits.clear();
    auto ball = std::lower_bound(balls.begin(), balls.end(), b.x.z() - reach - r_max,
                                 [](const BoundingSphere& a, double z) { return a.z < z; });
    for (; ball != balls.end() && ball->z <= b.x.z() + reach + r_max; ++ball) {
      const double far = reach + ball->r;
      if ((b.x - ball->c).squaredNorm() > far * far) continue;
      const double distance2 = (closest_on(wall, ball->t, b.x).point - b.x).squaredNorm();
      if (distance2 > reach * reach) continue;
      hits.push_back({topo.patch[uz(ball->t)], ball->t, distance2});
    }
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& c) {
      return std::pair{a.patch, a.triangle} < std::pair{c.patch, c.triangle};
    });
    for (const Hit& hit : hits) {
      if (found.empty() || found.back().particle != i || found.back().wall != hit.patch) {
        found.push_back({.particle = i, .wall = hit.patch});
        listed.push_back({.x = b.x, .first = near.size()});
      }
      const double beyond = b.R + activation_gap(wall.material) * b.S;
      const double clearance = std::sqrt(hit.distance2) - beyond;
      near.push_back({hit.triangle, clearance});
      listed.back().end = near.size();
      listed.back().clearance = std::min(listed.back().clearance, clearance);
    }
  });
  wall.contacts = carry_history(std::move(found), wall.contacts);
  wall.listed = std::move(listed);
  wall.near = std::move(near);
  wall.x_listed = wall.x;
}

double travel(const Wall& wall)
{
  if (wall.x_listed.size() != wall.x.size()) return std::numeric_limits<double>::infinity();
  double max2 = 0.0;
  for (std::size_t k = 0; k < wall.x.size(); ++k)
    max2 = std::max(max2, (wall.x[k] - wall.x_listed[k]).squaredNorm());
  return std::sqrt(max2);
}

void bond_to_wall(Wall& wall, Particles& p, double limit)
{
  if (!wall.bonds.empty()) throw std::logic_error("this wall is bonded already");
  std::vector<std::vector<int>> triangles_of(uz(wall.topology.n_patches));
  for (std::size_t t = 0; t < wall.topology.triangles.size(); ++t)
    triangles_of[uz(wall.topology.patch[t])].push_back(static_cast<int>(t));
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    // One bond per patch within the limit: a particle in a corner is bonded to both sides.
    for (const std::vector<int>& own : triangles_of) {
      Anchor anchor;
      const Vec3 point = closest_point_of_wall(wall, own, b.x, anchor);
      const double gap = (point - b.x).norm() - b.R;
      if (gap >= limit * b.S) continue;
      WallBond bond;
      bond.particle = i;
      bond.anchor = anchor;
      bond.gap_0 = gap;
      wall.bonds.push_back(bond);
      ++p.n_bonds[i];
    }
  });
}

} // namespace mergel::dem
