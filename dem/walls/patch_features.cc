/// Where a particle touches a smooth patch of a triangulated wall.
#include "dem/walls/patch_features.h"

#include "dem/walls/triangle.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mergel::dem {

namespace {

/// Bit k of the result is bit k - 1, and bit 0 is bit 2.
unsigned rotated(unsigned bits)
{
  return (bits << 1 | bits >> 2) & 7u;
}

bool has(unsigned bits, std::size_t k)
{
  return bits >> k & 1u;
}

/// Add 1 if bit k is set.
void count(std::uint8_t& n, unsigned bits, std::size_t k)
{
  n = static_cast<std::uint8_t>(n + (bits >> k & 1u));
}

/// Whether n points through this triangle from the side of the particles: no root and no angle.
bool enters(const Wall& wall, int t, const Vec3& n)
{
  const Triangle& k = wall.topology.triangles[uz(t)];
  const Vec3& x = wall.x[uz(k[0])];
  return n.dot((wall.x[uz(k[1])] - x).cross(wall.x[uz(k[2])] - x)) < 0.0;
}

/// The unit normal of a triangle, weighted with its angle at a corner.
Vec3 weighted_normal(const Wall& wall, int t, std::size_t corner)
{
  const Triangle& k = wall.topology.triangles[uz(t)];
  const Vec3 a = wall.x[uz(k[(corner + 1) % 3])] - wall.x[uz(k[corner])],
             b = wall.x[uz(k[(corner + 2) % 3])] - wall.x[uz(k[corner])];
  return std::atan2(a.cross(b).norm(), a.dot(b)) * normal(wall, t);
}

} // namespace

bool is_in_front(const Wall& wall, const PatchFeature& feature)
{
  using On = PatchFeature::On;
  const WallTopology& topo = wall.topology;
  const int t = feature.at.triangle;
  const auto is_entered = [&](int triangle) { return enters(wall, triangle, feature.n); };
  if (feature.on == On::face) return is_entered(t);
  if (feature.on == On::edge) {
    const int other = topo.across[uz(t)][uz(feature.which)];
    if (other < 0 || (is_entered(t) && is_entered(other))) return true;
    return feature.n.dot(normal(wall, t) + normal(wall, other)) < 0.0;
  }
  const int node = topo.triangles[uz(t)][uz(feature.which)];
  const std::vector<int>& around = topo.around[uz(node)];
  const auto place_in = [&](int triangle) {
    return place_of(node, topo.triangles[uz(triangle)]);
  };
  const bool is_at_boundary = std::any_of(around.begin(), around.end(), [&](int triangle) {
    const std::size_t here = place_in(triangle);
    return topo.across[uz(triangle)][here] < 0 ||
           topo.across[uz(triangle)][(here + 2) % 3] < 0;
  });
  // Through all of them: through their mean, whatever the weights.
  if (is_at_boundary || std::all_of(around.begin(), around.end(), is_entered)) return true;
  Vec3 n = Vec3::Zero();
  for (const int triangle : around)
    n += weighted_normal(wall, triangle, place_in(triangle));
  return feature.n.dot(n) < 0.0;
}

/// Collects triangles, and looks at n_lanes of them together.
class PatchFeatures::Scan {
public:
  /// @param beyond distance at which a feature touches [m]
  Scan(PatchFeatures& features, const Wall& wall, const ListedCandidate& candidate,
       const Vec3& c, double beyond)
      : features_(features), wall_(wall), c_(c), beyond_(beyond)
  {
    features_.found_.clear();
    features_.looked_at_.clear();
    features_.n_ways_.assign(candidate.n_nodes + candidate.n_edges, 0);
    ways_of_edge_ = features_.n_ways_.data() + candidate.n_nodes;
  }

  void add(const NearTriangle& near)
  {
    near_[count_] = &near;
    if (++count_ == n_lanes) look();
  }

  void finish()
  {
    if (count_ > 0) look();
    for (const LookedAt& triangle : features_.looked_at_) add_features(triangle);
  }

private:
  const Vec3& corner(const NearTriangle& t, std::size_t k) const
  {
    return wall_.x[uz(t.corners[k % 3])];
  }

  /// Bit l of the result: whether the plane of the triangle in lane l is near. @param code of
  /// each lane: bits 0 to 2 whether the distance falls from its edges into it, 3 to 5 along them
  /// from their first corners, 6 to 8 from their last
  unsigned look_at_lanes(Mask& code) const
  {
    Triple<Lanes> x[3];
    for (std::size_t k = 0; k < 3; ++k) {
      Row rows[n_lanes];
      for (int l = 0; l < n_lanes; ++l) {
        const Vec3& a = corner(*near_[l < count_ ? l : 0], k);
        rows[l] = Row{a.x(), a.y(), a.z(), 0.0};
      }
      Lanes unused;
      columns(rows, x[k].x, x[k].y, x[k].z, unused);
    }
    const Triple<Lanes> c{Lanes{} + c_.x(), Lanes{} + c_.y(), Lanes{} + c_.z()};
    const TriangleRegions<Lanes> r(c, x[0], x[1], x[2]);
    // Along an edge both triangles ask with the same bits: the vector from one corner to the
    // other times that to c.
    const Triple<Lanes> bd = x[2] - x[1], bc = c - x[1], dc = c - x[2];
    const Mask falls[9] = {r.vd > 0.0,
                           r.va > 0.0,
                           r.vb > 0.0, // into it
                           r.d1 > 0.0,
                           dot(bd, bc) > 0.0,
                           r.d6 < 0.0,                              // ahead
                           r.d3<0.0, dot(bd, dc) < 0.0, r.d2> 0.0}; // back
    code = Mask{};
    for (int k = 0; k < 9; ++k) code |= falls[k] & (1ll << k);
    const double limit = beyond_ * beyond_ * (1.0 + 1e-9); // a margin for its round-off
    // Not "near": what is not a number is found by the exact sums.
    const Triple<Lanes> n = cross(r.ab, r.ad);
    const Lanes height = dot(r.ac, n);
    return ~bits_of(height * height > limit * dot(n, n));
  }

  void look()
  {
    Mask codes;
    const unsigned may_touch = look_at_lanes(codes);
    for (int l = 0; l < count_; ++l) {
      if (!(may_touch >> l & 1u)) continue;
      const auto code = static_cast<unsigned>(codes[l]);
      const unsigned inwards = code & 7u, ahead = code >> 3 & 7u, back = code >> 6 & 7u;
      const NearTriangle& near = *near_[l];
      const unsigned foot = ahead & back, before = rotated(back);
      // A way is counted at the edge at which it begins, counter-clockwise.
      const unsigned ways = (before & ~ahead) | (near.begins_fan & ahead);
      for (std::size_t k = 0; k < 3; ++k) {
        count(ways_of_edge_[near.edge[k]], inwards, k);
        count(features_.n_ways_[near.node[k]], ways, k);
      }
      const int face = 1 + std::popcount(foot & inwards) - std::popcount(before & ahead);
      features_.looked_at_.push_back({&near, foot, face});
    }
    count_ = 0;
  }

  /// Those of this triangle, shared ones at the first of their triangles.
  void add_features(const LookedAt& looked_at)
  {
    using On = PatchFeature::On;
    const NearTriangle& near = *looked_at.near;
    const int t = near.triangle;
    if (looked_at.sign_of_face != 0) {
      const TrianglePoint<double> face = point_of_face(
          TriangleRegions<double>(triple(c_), triple(corner(near, 0)),
                                  triple(corner(near, 1)), triple(corner(near, 2))));
      add(On::face, 0, {t, vec3(face.weight)}, vec3(face.x), looked_at.sign_of_face);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (has(near.owns_edge & looked_at.foot, k)) {
        const int sign = 1 - ways_of_edge_[near.edge[k]];
        if (sign != 0) add_edge(near, k, sign);
      }
      if (has(near.owns_node, k)) {
        const int sign = near.n_fans[k] - features_.n_ways_[near.node[k]];
        if (sign != 0) {
          Vec3 weight = Vec3::Zero();
          weight[static_cast<int>(k)] = 1.0;
          add(On::corner, static_cast<int>(k), {t, weight}, corner(near, k), sign);
        }
      }
    }
  }

  void add_edge(const NearTriangle& t, std::size_t e, int sign)
  {
    const Vec3 &a = corner(t, e), &b = corner(t, e + 1);
    const Vec3 ab = b - a;
    const double s = (c_ - a).dot(ab) / ab.squaredNorm(); // an edge has a length
    Vec3 weight = Vec3::Zero();
    weight[static_cast<int>(e)] = 1.0 - s;
    weight[static_cast<int>((e + 1) % 3)] = s;
    add(PatchFeature::On::edge, static_cast<int>(e), {t.triangle, weight}, a + s * ab,
        sign);
  }

  void add(PatchFeature::On on, int which, const Anchor& at, const Vec3& point, int sign)
  {
    const Triple<double> r = triple(point) - triple(c_); // as the lanes of a batch
    const double d = sqrt(dot(r, r)), overlap = beyond_ - d;
    if (overlap <= 0.0) return; // one that is not a number is found by the exact sums
    features_.found_.push_back(
        {on, which, at, point, vec3(r * (1.0 / d)), d, overlap, double(sign)});
  }

  PatchFeatures& features_;
  const Wall& wall_;
  const Vec3 c_;
  const double beyond_;
  std::uint8_t* ways_of_edge_;
  int count_ = 0; ///< of the triangles that wait
  const NearTriangle* near_[n_lanes];
};

void PatchFeatures::find(const Wall& wall, const ListedCandidate& candidate,
                         const ParticleState& particle, double wall_travel)
{
  const double motion = candidate.motion(particle, wall_travel);
  Scan scan(*this, wall, candidate, particle.x,
            particle.R + activation_gap(wall.material) * particle.S);
  for (const NearTriangle& near : wall.near_triangles(candidate))
    if (near.clearance <= motion) scan.add(near);
  scan.finish();
  if (found_.empty()) return;
  // Only what is in contact is judged: which other triangles were examined depends on the
  // list. No centre gets past a wall without a contact before.
  if (!is_in_front(wall, nearest()))
    throw NumericalError("its centre is on the wrong side of a wall");
}

void PatchFeatures::find_within(const Wall& wall, const ListedCandidate& candidate,
                                std::span<const NearTriangle> near, const Vec3& x,
                                double reach)
{
  Scan scan(*this, wall, candidate, x, reach);
  for (const NearTriangle& t : near) {
    const Vec3& corner = wall.x[uz(t.corners[0])];
    if ((x - corner).dot(normal(wall, t.triangle)) <= reach) scan.add(t); // its plane
  }
  scan.finish();
}

const PatchFeature& PatchFeatures::nearest() const
{
  return *std::max_element(
      found_.begin(), found_.end(),
      [](const PatchFeature& a, const PatchFeature& b) { return a.overlap < b.overlap; });
}

} // namespace mergel::dem
