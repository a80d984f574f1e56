#include "dem/assembly/springs.h"

#include "dem/walls/patch_features.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

/// Share of the skin up to which open contacts count.
constexpr double skin_share_counted = 0.25;
/// Over the present speed of approach: a particle may gather speed until the next check.
constexpr double speed_reserve = 2.0;

/// Decides which contacts count.
struct Closing {
  double horizon; ///< [s]
  double limit;   ///< of the gap beyond g_a at S = 1 [m]
  bool walls_move;

  /// Overlap at the end of the horizon; not positive if the contact does not count.
  /// @param overlap now [m]; @param approach speed [m/s]
  double overlap(double overlap_now, double approach, double S) const
  {
    const double most = limit * S;
    if (std::isinf(horizon)) return overlap_now + most;
    return overlap_now + std::min(most, speed_reserve * horizon * std::max(0.0, approach));
  }
};

/// Bond and contact of one pair; nothing if neither acts.
void add_pair(Springs& s, const Assembly& a, const Closing& closing, const Pair& q,
              double intact)
{
  const Particles& p = a.particles;
  const ParticleState &i = p.state[q.i], &j = p.state[q.j];
  const double L = i.R + j.R, S = 0.5 * (i.S + j.S);
  const double g_a = activation_gap(a.material.contact) * S;
  const Vec3 r = j.x + a.cell.offset(q.shift) - i.x;
  const double reach = L + g_a + closing.limit * S;
  const double d2 = r.squaredNorm();
  if (intact == 0.0 && d2 > reach * reach) return; // most pairs end here

  const double d = std::sqrt(d2), gap = d - L;
  PairSpring k{q.i, q.j, i.R + 0.5 * gap, j.R + 0.5 * gap, r / d, 0.0, 0.0, 0.0, 0.0};
  if (intact > 0.0) {
    const auto b = bond_shape(section(a.material.bond), std::min(i.R, j.R), 1.0 / L);
    k.k_n = intact * b.k_n;
    k.k_s = intact * b.k_s;
    k.k_b = intact * b.k_b;
    k.k_t = intact * b.k_t;
  }
  Vec3 v = j.v - i.v;
  if (a.cell.is_strain_controlled) v += r.cwiseProduct(a.cell.rate);
  const double overlap = closing.overlap(g_a - gap, -v.dot(k.n), S);
  if (overlap > 0.0) {
    const auto c =
        contact_stiffness(a.material.contact, sides_of_pair(i.R, j.R, 1.0 / L), overlap);
    k.k_n += c.k_n;
    k.k_s += c.k_s;
  }
  if (k.k_n > 0.0) s.pairs.push_back(k);
}

/// Springs along the principal directions of the stiffness of several features of a patch, in
/// which saddles count against. They act at the nearest feature, where the shear spring is.
std::vector<WallSpring> principal(const std::vector<WallSpring>& of_features,
                                  const Eigen::Matrix3d& stiffness)
{
  const WallSpring& nearest = *std::min_element(
      of_features.begin(), of_features.end(),
      [](const WallSpring& a, const WallSpring& b) { return a.arm < b.arm; });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stiffness);
  std::vector<WallSpring> springs;
  for (int k = 2; k >= 0; --k) { // the stiffest first
    WallSpring spring = nearest;
    spring.k_n = solver.eigenvalues()[k];
    spring.n = solver.eigenvectors().col(k);
    if (spring.n.dot(nearest.n) < 0.0) spring.n = -spring.n;
    if (k < 2) spring.k_s = 0.0;
    if (spring.k_n > 0.0) springs.push_back(spring);
  }
  return springs;
}

/// Springs to the features of a surface that count.
/// @param v_at velocity of the wall at a feature
template <class Velocity, class ToSpring>
void add_features(Springs& s, const Closing& closing, const ContactLaw& law,
                  const ParticleState& b, const std::vector<PatchFeature>& found,
                  Velocity&& v_at, ToSpring&& spring_of)
{
  const double g_a = activation_gap(law) * b.S;
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  std::vector<WallSpring> springs; // by feature
  for (const PatchFeature& f : found) {
    const Vec3 v = b.v - v_at(f);
    const Vec3 n = (f.point - b.x) / f.distance;
    const double overlap = closing.overlap(g_a - (f.distance - b.R), v.dot(n), b.S);
    if (!(overlap > 0.0)) continue;
    const auto k = contact_stiffness(law, sides_at_wall(b.R), overlap);
    springs.push_back(spring_of(f, n, f.sign * k.k_n, k.k_s));
    stiffness += f.sign * k.k_n * n * n.transpose();
  }
  if (springs.size() > 1) springs = principal(springs, stiffness);
  s.walls.insert(s.walls.end(), springs.begin(), springs.end());
}

void add_polyhedron(Springs& s, const Assembly& a, const Closing& closing,
                    const RigidWall& wall)
{
  FeaturesOfWall features(wall);
  for (const WallContact& c : wall.contacts) {
    const ParticleState& b = a.particles.state[c.particle];
    const double reach = b.R + activation_gap(wall.material) * b.S + closing.limit * b.S;
    const std::vector<PatchFeature>& found = with_particle_id(
        a.particles.id[c.particle],
        [&]() -> const std::vector<PatchFeature>& { return features.find(b.x, reach); });
    add_features(
        s, closing, wall.material, b, found,
        [&](const PatchFeature& f) { return wall.velocity_at(f.point); },
        [&](const PatchFeature& f, const Vec3& n, double k_n, double k_s) {
          return WallSpring{c.particle, f.distance, n, k_n, k_s};
        });
  }
}

void add_wall(Springs& s, const Assembly& a, const Closing& closing, const RigidWall& wall)
{
  if (std::holds_alternative<Polyhedron>(wall.shape))
    return add_polyhedron(s, a, closing, wall);
  for (const WallContact& c : wall.contacts) {
    const ParticleState& b = a.particles.state[c.particle];
    const SurfacePoint at = with_particle_id(a.particles.id[c.particle],
                                             [&] { return closest_point(wall, b); });
    const double overlap =
        closing.overlap(activation_gap(wall.material) * b.S - at.gap,
                        (b.v - wall.velocity_at(at.point)).dot(at.n), b.S);
    if (!(overlap > 0.0)) continue;
    const auto k = contact_stiffness(wall.material, sides_at_wall(b.R), overlap);
    s.walls.push_back({c.particle, b.R + at.gap, at.n, k.k_n, k.k_s});
  }
}

void add_wall(Springs& s, const Assembly& a, const Closing& closing, const Wall& wall)
{
  const std::size_t number = closing.walls_move
                                 ? static_cast<std::size_t>(&wall - a.walls.data())
                                 : WallSpring::held;
  PatchFeatures features;
  for (std::size_t c = 0; c < wall.contacts.size(); ++c) {
    const ParticleState& b = a.particles.state[wall.contacts[c].particle];
    const double g_a = activation_gap(wall.material) * b.S;
    features.find_within(wall, wall.listed[c], b.x, b.R + g_a + closing.limit * b.S);
    add_features(
        s, closing, wall.material, b, features.found(),
        [&](const PatchFeature& f) { return at(wall.v, wall.topology, f.at); },
        [&](const PatchFeature& f, const Vec3& n, double k_n, double k_s) {
          return WallSpring{
              wall.contacts[c].particle, f.distance, n, k_n, k_s, number, f.at};
        });
  }
  for (const WallBond& bond : wall.bonds) {
    if (bond.state.intact == 0.0) continue;
    const ParticleState& b = a.particles.state[bond.particle];
    const auto k = bond_shape(section(a.material.bond), b.R, 1.0 / b.R);
    const Vec3 r = at(wall.x, wall.topology, bond.anchor) - b.x;
    const double d = r.norm();
    s.walls.push_back({bond.particle, d, r / d, bond.state.intact * k.k_n,
                       bond.state.intact * k.k_s, number, bond.anchor});
  }
}

void add_wall(Springs& s, const Assembly& a, const Closing& closing, const Mirror& mirror)
{
  for (const MirrorPair& m : mirror.pairs) {
    const ParticleState& b = a.particles.state[m.particle];
    double k_n = 0.0;
    if (m.bond.intact > 0.0)
      k_n += m.bond.intact * bond_shape(section(a.material.bond), b.R, 0.5 / b.R).k_n;
    const double overlap =
        closing.overlap(activation_gap(a.material.contact) * b.S - 2.0 * (b.x.y() - b.R),
                        -2.0 * b.v.y(), b.S);
    if (overlap > 0.0)
      k_n += contact_stiffness(a.material.contact, sides_at_mirror(b.R), overlap).k_n;
    if (k_n > 0.0)
      s.walls.push_back({m.particle, b.x.y(), {0.0, -1.0, 0.0}, 2.0 * k_n, 0.0});
  }
}

} // namespace

double open_gap_counted(const Assembly& assembly)
{
  return skin_share_counted * assembly.list.skin();
}

Springs linear_springs(const Assembly& assembly, const Ahead& ahead)
{
  const Closing closing{ahead.horizon, open_gap_counted(assembly), ahead.walls_move};
  Springs s;
  s.pairs.reserve(assembly.bonds.size());
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b)
    add_pair(s, assembly, closing, assembly.bonds.pairs[b], assembly.bonds.intact(b));
  for (const Pair& q : assembly.contacts.pairs) add_pair(s, assembly, closing, q, 0.0);
  for_each_wall(assembly, [&](const auto& w) { add_wall(s, assembly, closing, w); });
  return s;
}

std::vector<Mobility> mobilities(const Assembly& assembly)
{
  const Particles& p = assembly.particles;
  std::vector<Mobility> all(p.size(), {0.0, Vec3::Zero()});
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    all[i].translation = 1.0 / std::sqrt(b.m);
    if (spins(p, assembly.motion, i))
      all[i].rotation.setConstant(1.0 / std::sqrt(inertia(b, assembly.motion)));
  });
  for (const Mirror& mirror : assembly.mirrors)
    for (const MirrorPair& m : mirror.pairs)
      if (m.bond.intact > 0.0)
        all[m.particle].rotation.x() = all[m.particle].rotation.z() = 0.0;
  return all;
}

} // namespace mergel::dem
