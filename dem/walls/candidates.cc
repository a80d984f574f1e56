/// Candidates of a triangulated wall, and new wall bonds.
#include "dem/walls/closest_on_triangle.h"
#include "dem/walls/feature_numbers.h"
#include "dem/walls/surface_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mergel::dem {

namespace {

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

void rebuild_wall(Wall& wall, const PairMaterials&, const Particles& p, double skin,
                  const std::vector<double>& extra)
{
  std::vector<WallContact> found;
  std::vector<ListedCandidate> listed;
  std::vector<NearTriangle> near;
  const WallTopology& topo = wall.topology;

  const SurfaceSearch search(wall.x, topo.triangles);
  std::vector<int> near_box;
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
    search.within(b.x, reach, near_box);
    for (const int t : near_box) {
      const double distance2 = (closest_on(wall, t, b.x).point - b.x).squaredNorm();
      if (distance2 > reach * reach) continue;
      hits.push_back({topo.patch[uz(t)], t, distance2});
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
