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

/// Whether c is on the side of the particles of the feature that is closest to it: by the mean
/// normal of the triangles around, weighted with their angles. At the boundary of a wall there
/// is no wrong side.
/// Source: Baerentzen and Aanaes (2005), IEEE Trans. Vis. Comput. Graph. 11, 243.
bool is_in_front(const Wall& wall, int t, const ClosestFeature& at, const Vec3& c)
{
  using On = ClosestFeature::On;
  const WallTopology& topo = wall.topology;
  Vec3 n = normal(wall, t);
  if (at.on == On::edge) {
    const int other = topo.across[uz(t)][uz(at.which)];
    if (other < 0) return true;
    n += normal(wall, other);
  } else if (at.on == On::corner) {
    const int node = topo.triangles[uz(t)][uz(at.which)];
    n.setZero();
    for (const int around : topo.around[uz(node)]) {
      const Triangle& k = topo.triangles[uz(around)];
      const int here = k[0] == node ? 0 : k[1] == node ? 1 : 2;
      if (topo.across[uz(around)][uz(here)] < 0 ||
          topo.across[uz(around)][uz((here + 2) % 3)] < 0)
        return true;
      const Vec3 a = wall.x[uz(k[uz((here + 1) % 3)])] - wall.x[uz(node)],
                 b = wall.x[uz(k[uz((here + 2) % 3)])] - wall.x[uz(node)];
      n += std::atan2(a.cross(b).norm(), a.dot(b)) * normal(wall, around);
    }
  }
  return (c - at.point).dot(n) > 0.0;
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

/// Finds the features of a patch at which the distance of its points to c is stationary.
///
/// A feature counts 1 less the number of separate ways down from it. Whether the distance
/// falls from a corner along an edge has the same bits in all triangles, and whether it falls
/// from an edge into a triangle is asked in one way. The sign of a face follows from these
/// answers alone. So each triangle counts 1 in all, and the signs of a flat patch sum to 1
/// also where round-off decides.
class StationaryPoints {
public:
  /// @param beyond distance at which a feature touches [m]
  StationaryPoints(const Wall& wall, const Vec3& c, double beyond,
                   std::vector<PatchFeature>& found)
      : wall_(wall), c_(c), beyond_(beyond), found_(found)
  {
  }

  /// Those of this triangle, shared ones by the first of their triangles.
  void add(int t)
  {
    const Triangle& k = wall_.topology.triangles[uz(t)];
    const TriangleRegions<double> regions = regions_of(t);
    const std::array<bool, 3> inwards = falls_inwards(regions);
    std::array<bool, 3> ahead, back; // along edge e, from its first and its last corner
    for (std::size_t e = 0; e < 3; ++e) {
      ahead[e] = falls(k[e], k[(e + 1) % 3]);
      back[e] = falls(k[(e + 1) % 3], k[e]);
    }
    int sign = 1;
    for (std::size_t e = 0; e < 3; ++e) {
      sign += ahead[e] && back[e] && inwards[e];
      sign -= ahead[e] && back[(e + 2) % 3];
    }
    if (sign != 0) {
      const TrianglePoint<double> face = point_of_face(regions);
      add({t, vec3(face.weight)}, vec3(face.x), sign);
    }
    for (int e = 0; e < 3; ++e) {
      if (ahead[uz(e)] && back[uz(e)]) add_edge(t, e, inwards[uz(e)]);
      add_corner(t, e);
    }
  }

private:
  const Vec3& corner(int t, int k) const
  {
    return wall_.x[uz(wall_.topology.triangles[uz(t)][uz(k % 3)])];
  }

  TriangleRegions<double> regions_of(int t) const
  {
    return {triple(c_), triple(corner(t, 0)), triple(corner(t, 1)), triple(corner(t, 2))};
  }

  void add(const Anchor& at, const Vec3& point, int sign)
  {
    const double d = distance(c_, point), overlap = beyond_ - d;
    if (overlap <= 0.0) return; // one that is not a number is found by the exact sums
    found_.push_back({at, point, (point - c_) * (1.0 / d), d, overlap, double(sign)});
  }

  bool touches(const Vec3& point) const
  {
    return (point - c_).squaredNorm() < beyond_ * beyond_;
  }

  /// Whether the distance falls from a node towards another.
  bool falls(int from, int to) const
  {
    const Vec3& x = wall_.x[uz(from)];
    return (c_ - x).dot(wall_.x[uz(to)] - x) > 0.0;
  }

  /// Whether the distance falls from each edge into the triangle.
  static std::array<bool, 3> falls_inwards(const TriangleRegions<double>& r)
  {
    return {r.vd > 0.0, r.va > 0.0, r.vb > 0.0};
  }

  /// An edge with the foot of c on it: along it the distance is smallest. Across a ridge it is
  /// smallest too, across a valley largest: a saddle.
  void add_edge(int t, int e, bool falls_here)
  {
    const int other = wall_.topology.across[uz(t)][uz(e)];
    if (other >= 0 && other < t) return;
    const Vec3 &a = corner(t, e), &b = corner(t, e + 1);
    const Vec3 ab = b - a;
    const double s = (c_ - a).dot(ab) / ab.squaredNorm(); // an edge has a length
    const Vec3 point = a + s * ab;
    if (!touches(point)) return;
    int n_ways = falls_here;
    if (other >= 0) n_ways += falls_inwards(regions_of(other))[uz(edge_of(other, t))];
    if (n_ways == 1) return;
    Vec3 weight = Vec3::Zero();
    weight[e] = 1.0 - s;
    weight[(e + 1) % 3] = s;
    add({t, weight}, point, 1 - n_ways);
  }

  int edge_of(int t, int neighbour) const
  {
    const auto& across = wall_.topology.across[uz(t)];
    return across[0] == neighbour ? 0 : across[1] == neighbour ? 1 : 2;
  }

  /// The triangles of the patch around a corner lie in a ring, or in fans from one edge of the
  /// patch to another. Each fan has a corner of its own.
  void add_corner(int t, int k)
  {
    const WallTopology& topo = wall_.topology;
    if (!touches(corner(t, k))) return;
    const int node = topo.triangles[uz(t)][uz(k)];
    int n_ways = 0, n_fans = 0;
    for (const int around : topo.around[uz(node)]) {
      if (topo.patch[uz(around)] != topo.patch[uz(t)]) continue;
      if (around < t) return; // it has the corner already
      const Triangle& tri = topo.triangles[uz(around)];
      const std::size_t at = tri[0] == node ? 0 : tri[1] == node ? 1 : 2;
      const bool first = falls(node, tri[(at + 1) % 3]),
                 second = falls(node, tri[(at + 2) % 3]);
      const bool begins_fan = topo.across[uz(around)][at] < 0;
      n_fans += begins_fan;
      // A way is counted at the edge at which it begins, counter-clockwise.
      n_ways += (second && !first) + (begins_fan && first);
    }
    const int sign = std::max(n_fans, 1) - n_ways;
    if (sign == 0) return;
    Vec3 weight = Vec3::Zero();
    weight[k] = 1.0;
    add({t, weight}, corner(t, k), sign);
  }

  const Wall& wall_;
  const Vec3 c_;
  const double beyond_;
  std::vector<PatchFeature>& found_;
};

/// Calls visit(t) for the candidate's triangles that may be nearer to c than `beyond` [m]:
/// n_lanes of them are looked at together.
template <class Visit>
void visit_touching(const Wall& wall, const ListedCandidate& candidate, const Vec3& c,
                    double beyond, double moved, Visit&& visit)
{
  const double limit = beyond * beyond * (1.0 + 1e-9); // a margin for its round-off
  int t[n_lanes];
  int count = 0;
  const auto look = [&] {
    Row rows[3][n_lanes];
    for (int l = 0; l < n_lanes; ++l) {
      const Triangle& k = wall.topology.triangles[uz(t[l < count ? l : 0])];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vec3& x = wall.x[uz(k[corner])];
        rows[corner][l] = Row{x.x(), x.y(), x.z(), 0.0};
      }
    }
    Triple<Lanes> x[3];
    Lanes unused;
    for (int corner = 0; corner < 3; ++corner)
      columns(rows[corner], x[corner].x, x[corner].y, x[corner].z, unused);
    const Triple<Lanes> centre{Lanes{} + c.x(), Lanes{} + c.y(), Lanes{} + c.z()};
    // Not "near": what is not a number is found by the exact sums.
    const unsigned far =
        bits_of(squared_distance(TriangleRegions<Lanes>(centre, x[0], x[1], x[2])) > limit);
    const int n = count;
    count = 0;
    for (int l = 0; l < n; ++l)
      if (!(far >> l & 1u)) visit(t[l]);
  };
  for (const auto& [triangle, clearance] : wall.near_triangles(candidate)) {
    if (clearance > moved) continue;
    t[count] = triangle;
    if (++count == n_lanes) look();
  }
  if (count > 0) look();
}

} // namespace

void find_patch_features(const Wall& wall, const ListedCandidate& candidate,
                         const ParticleState& particle, double wall_travel,
                         std::vector<PatchFeature>& found)
{
  found.clear();
  const double beyond = particle.R + activation_gap(wall.material) * particle.S;
  StationaryPoints points(wall, particle.x, beyond, found);
  int nearest = -1;
  ClosestFeature at_nearest{};
  double smallest = std::numeric_limits<double>::infinity();
  visit_touching(wall, candidate, particle.x, beyond,
                 candidate.motion(particle, wall_travel), [&](int t) {
                   const ClosestFeature at = closest_on(wall, t, particle.x);
                   const double d = distance(particle.x, at.point);
                   if (d >= beyond) return;
                   if (d < smallest) {
                     smallest = d;
                     nearest = t;
                     at_nearest = at;
                   }
                   points.add(t);
                 });
  // Only what is in contact is judged: which other triangles were examined depends on the
  // list. No centre gets past a wall without a contact before.
  if (nearest >= 0 && !is_in_front(wall, nearest, at_nearest, particle.x))
    throw NumericalError("its centre is on the wrong side of a wall");
}

void find_features_within(const Wall& wall, const ListedCandidate& candidate, const Vec3& x,
                          double reach, std::vector<PatchFeature>& found)
{
  found.clear();
  StationaryPoints points(wall, x, reach, found);
  for (const NearTriangle& near : wall.near_triangles(candidate)) {
    const Vec3& corner = wall.x[uz(wall.topology.triangles[uz(near.triangle)][0])];
    if ((x - corner).dot(normal(wall, near.triangle)) > reach) continue; // of its plane
    points.add(near.triangle);
  }
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
