/// Candidates of a triangulated wall, and new wall bonds.
#include "dem/walls/triangle.h"
#include "dem/walls/triangulated.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mergel::dem {

namespace {

/// Closest point of a triangle.
struct ClosestPoint {
  Vec3 weight; ///< barycentric
  Vec3 point;
};

ClosestPoint closest_on_triangle(const Vec3& c, const Vec3& a, const Vec3& b, const Vec3& d)
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

ClosestPoint closest_on(const Wall& wall, int t, const Vec3& c)
{
  const Triangle& k = wall.topology.triangles[uz(t)];
  return closest_on_triangle(c, wall.x[uz(k[0])], wall.x[uz(k[1])], wall.x[uz(k[2])]);
}

Vec3 closest_point_of_wall(const Wall& wall, const std::vector<int>& triangles,
                           const Vec3& c, Anchor& anchor)
{
  double best = std::numeric_limits<double>::infinity();
  Vec3 point = Vec3::Zero();
  for (const int t : triangles) {
    const ClosestPoint at = closest_on(wall, t, c);
    const double d2 = (c - at.point).squaredNorm();
    if (d2 >= best) continue;
    best = d2;
    point = at.point;
    anchor = {t, at.weight};
  }
  return point;
}

} // namespace

namespace {

/// Numbers the corners and edges of a candidate's triangles.
class FeatureNumbers {
public:
  explicit FeatureNumbers(const WallTopology& topo)
      : topo_(topo), node_(topo.around.size()), listed_(topo.triangles.size())
  {
  }

  /// @param near the triangles of the candidate, ascending
  void number(ListedCandidate& candidate, std::span<NearTriangle> near)
  {
    ++candidate_;
    std::size_t n_nodes = 0, n_edges = 0;
    for (NearTriangle& t : near) {
      t.n_fans = topo_.n_fans[uz(t.triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto bit = static_cast<std::uint8_t>(1u << k);
        Mark& node = node_[uz(topo_.triangles[uz(t.triangle)][k])];
        if (node.candidate != candidate_) {
          node = {candidate_, n_nodes++};
          t.owns_node |= bit;
        }
        t.node[k] = static_cast<std::uint16_t>(node.number);

        const int other = topo_.across[uz(t.triangle)][k];
        if (other < 0) t.begins_fan |= bit;
        if (other >= 0 && other < t.triangle &&
            listed_[uz(other)].candidate == candidate_) {
          const std::size_t e = place_of(t.triangle, topo_.across[uz(other)]);
          t.edge[k] = near[listed_[uz(other)].number].edge[e];
        } else {
          t.edge[k] = static_cast<std::uint16_t>(n_edges++);
          t.owns_edge |= bit;
        }
      }
      listed_[uz(t.triangle)] = {candidate_, static_cast<std::size_t>(&t - near.data())};
    }
    candidate.n_nodes = n_nodes;
    candidate.n_edges = n_edges;
    if (n_edges > std::numeric_limits<std::uint16_t>::max())
      throw NumericalError("a particle reaches " + std::to_string(near.size()) +
                           " triangles of a wall: mesh it more coarsely");
  }

private:
  struct Mark {
    std::size_t candidate = 0, number = 0;
  };

  const WallTopology& topo_;
  std::vector<Mark> node_;   ///< by node of the wall
  std::vector<Mark> listed_; ///< by triangle of the wall
  std::size_t candidate_ = 0;
};

} // namespace

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
      near.push_back({.triangle = hit.triangle, .clearance = clearance});
      listed.back().end = near.size();
      listed.back().clearance = std::min(listed.back().clearance, clearance);
    }
  });
  FeatureNumbers numbers(topo);
  for (ListedCandidate& c : listed)
    numbers.number(c, std::span(near).subspan(c.first, c.end - c.first));
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

void slide_anchors(Wall& wall, const Particles& p, double dt)
{
  for (WallBond& bond : wall.bonds) {
    if (bond.state.intact == 0.0) continue;
    const ParticleState& b = p.state[bond.particle];
    const Triangle& t = wall.topology.triangles[uz(bond.anchor.triangle)];
    const Vec3 &x_0 = wall.x[uz(t[0])], &x_1 = wall.x[uz(t[1])], &x_2 = wall.x[uz(t[2])];
    const Vec3 before = at(wall.x, wall.topology, bond.anchor) - (b.x - dt * b.v);
    const Vec3 area = (x_1 - x_0).cross(x_2 - x_0); // twice the triangle's, not zero
    const double approach = before.dot(area);
    if (approach == 0.0) continue; // a particle in the plane of the triangle
    // Where the line from the particle in this direction meets the plane of the triangle.
    const Vec3 x = b.x + before * ((x_0 - b.x).dot(area) / approach);
    const double size2 = area.squaredNorm();
    const double w_1 = (x - x_0).cross(x_2 - x_0).dot(area) / size2,
                 w_2 = (x_1 - x_0).cross(x - x_0).dot(area) / size2;
    bond.anchor.weight = {1.0 - w_1 - w_2, w_1, w_2};
  }
}

} // namespace mergel::dem
