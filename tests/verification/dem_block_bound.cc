// dem/README.md, Time step: largest frequency and block bound of 1,000 small random
// assemblies against a dense eigenvalue solver.
#include "tests/support/catch.h"
#include "tests/support/strain_controlled_assembly.h"

#include <Eigen/Eigenvalues>

#include <utility>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Random particles in a corner of plane, triangulated wall and mirror: some bonded, some
/// bonds damaged, some contacts closed, all stiffness ratios random.
Assembly random_assembly(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double a, double b) { return a + (b - a) * unit(random); };
  Scene s;
  DamageBond bond = unbreakable_bond();
  bond.kappa = between(0.5, 10.0);
  bond.lambda_b = between(0.2, 1.0);
  bond.twist = unit(random) < 0.5 ? Twist::none : Twist::elastic;
  s.material = {bond, contact(between(1e7, 1e9), between(0.5, 10.0), 0.5, 1e-4)};
  s.motion.free_rotation = unit(random) < 0.5;
  s.motion.inertia_factor = between(0.3, 3.0);
  const int n = 1 + static_cast<int>(between(0.0, 7.0));
  const auto off = [&](double R) { return between(0.95 * R, 4e-3); }; // of a wall
  for (int k = 0; k < n; ++k) {
    const double R = between(0.5e-3, 1e-3), x = off(R), y = off(R), z = off(R);
    s.p.add(sphere({x, y, z}, R, between(1000.0, 4000.0)));
  }
  std::vector<Pair> pairs;
  for (Index i = 0; i < s.p.size(); ++i)
    for (Index j = i + 1; j < s.p.size(); ++j)
      if (unit(random) < 0.5) pairs.push_back({i, j, {}});
  s.bond(pairs);
  for (std::size_t b = 0; b < pairs.size(); ++b)
    if (unit(random) < 0.5)
      s.bonds.blocks[b / n_lanes].intact[b % n_lanes] = between(0.05, 1.0);

  Assembly a = assembly_of(s);
  const ContactLaw at_wall = contact(between(1e7, 1e9), between(0.5, 10.0), 0.5, 1e-4);
  if (unit(random) < 0.5)
    a.rigid_walls.push_back(make_rigid_wall(Plane{}, Vec3::Zero(), at_wall));
  if (unit(random) < 0.5) {
    a.walls.push_back(
        make_wall({{0, -1, -1}, {0, 3, -1}, {0, -1, 3}}, {{0, 1, 2}}, at_wall));
    if (unit(random) < 0.5) bond_to_wall(a.walls.front(), a.particles, 5e-4);
  }
  if (unit(random) < 0.5) {
    a.mirrors.emplace_back();
    if (unit(random) < 0.5) bond_to_mirror(a.mirrors.front(), a.particles, 5e-4);
  }
  rebuild_lists(a);
  return a;
}

/// Largest eigenvalue of M^-1/2 K M^-1/2. Each spring adds k b b^T, b its elongation under a
/// unit motion of each of the 6 N degrees of freedom: particle by particle, translation
/// before rotation.
double dense_frequency2(const Assembly& a, const Springs& springs)
{
  const auto size = static_cast<Eigen::Index>(6 * a.particles.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  const auto translation = [](Index p) { return static_cast<Eigen::Index>(6 * p); };
  const auto rotation = [](Index p) { return static_cast<Eigen::Index>(6 * p + 3); };
  const auto frame = [](const Vec3& n) { // two unit vectors normal to n
    const Vec3 e = n.unitOrthogonal();
    return std::pair{e, Vec3(n.cross(e))};
  };
  const auto add = [&](double k, const Eigen::VectorXd& b) { K += k * b * b.transpose(); };
  for (const PairSpring& s : springs.pairs) {
    const auto [e, f] = frame(s.n);
    for (const auto& [k, along] : {std::pair{s.k_n, s.n}, {s.k_s, e}, {s.k_s, f}}) {
      // Motion of the contact point with each particle, j less i.
      Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
      b.segment<3>(translation(s.i)) = -along;
      b.segment<3>(translation(s.j)) = along;
      b.segment<3>(rotation(s.i)) = -(s.a_i * s.n).cross(along);
      b.segment<3>(rotation(s.j)) = -(s.a_j * s.n).cross(along);
      add(k, b);
    }
    for (const auto& [k, about] : {std::pair{s.k_t, s.n}, {s.k_b, e}, {s.k_b, f}}) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
      b.segment<3>(rotation(s.i)) = -about;
      b.segment<3>(rotation(s.j)) = about;
      add(k, b);
    }
  }
  for (const WallSpring& s : springs.walls) {
    const auto [e, f] = frame(s.n);
    for (const auto& [k, along] : {std::pair{s.k_n, s.n}, {s.k_s, e}, {s.k_s, f}}) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
      b.segment<3>(translation(s.particle)) = along;
      b.segment<3>(rotation(s.particle)) = (s.arm * s.n).cross(along);
      add(k, b);
    }
  }
  Eigen::VectorXd scale(size);
  const std::vector<Mobility> m = mobilities(a);
  for (Index p = 0; p < a.particles.size(); ++p) {
    scale.segment<3>(translation(p)).setConstant(m[p].translation);
    scale.segment<3>(rotation(p)) = m[p].rotation;
  }
  const Eigen::MatrixXd A = scale.asDiagonal() * K * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly)
      .eigenvalues()[size - 1];
}

/// The smallest bound, and the largest miss of the iteration over many assemblies.
struct Extremes {
  double smallest_bound = std::numeric_limits<double>::infinity(); ///< over omega^2 [-]
  double lowest = std::numeric_limits<double>::infinity();         ///< omega^2 found [-]
  double highest = 0.0;
  int n = 0;
};

Extremes extremes_of_random_assemblies()
{
  std::mt19937_64 random(5);
  Extremes x;
  while (x.n < 1000) {
    const Assembly a = random_assembly(random);
    const Springs springs = linear_springs(a, {});
    const double bound = block_bound(a, springs).omega2;
    if (bound == 0.0) { // nothing touches
      REQUIRE((springs.pairs.empty() && springs.walls.empty()));
      continue;
    }
    const double exact = dense_frequency2(a, springs);
    const double found = largest_frequency2(a, springs, bound);
    x.smallest_bound = std::min(x.smallest_bound, bound / exact);
    x.lowest = std::min(x.lowest, found / exact);
    x.highest = std::max(x.highest, found / exact);
    ++x.n;
  }
  return x;
}

} // namespace

TEST_CASE("In 1,000 random assemblies the block bound is never below the largest squared "
          "frequency, which the iteration finds",
          "[verification][dem]")
{
  const Extremes x = extremes_of_random_assemblies();
  CAPTURE(x.n, x.smallest_bound, x.lowest, x.highest);
  REQUIRE(x.n == 1000);
  // Round-off of 42 x 42 matrices.
  CHECK(x.smallest_bound > 1.0 - 1e-12);
  CHECK(x.highest < 1.0 + 1e-12);
  // The iteration ends when two products raise it by less than 1e-4 of itself. Where the two
  // largest eigenvalues lie close together that leaves up to 5e-3 here: 2.5e-3 of the step.
  CHECK(x.lowest > 1.0 - 1e-2);
}

TEST_CASE("The stiffest particle is that of the largest of all block bounds, with its bits",
          "[verification][dem]")
{
  // The quick bound passes over particles, but never over the stiffest one.
  std::mt19937_64 random(6);
  for (int k = 0; k < 300; ++k) {
    const Assembly a = random_assembly(random);
    const Springs springs = linear_springs(a, {});
    const std::vector<double> bounds = block_bounds(a, springs);
    const auto largest = std::max_element(bounds.begin(), bounds.end());
    const StiffestParticle stiffest = block_bound(a, springs);
    // The eigenvalue without eigenvectors comes from another iteration: round-off.
    REQUIRE(stiffest.omega2 == Approx(*largest).epsilon(1e-13));
    if (stiffest.omega2 > 0.0)
      REQUIRE(stiffest.id == static_cast<std::uint64_t>(largest - bounds.begin()));
  }
  const Assembly a = disordered_crystal(3).assembly;
  const Springs springs = linear_springs(a, {});
  const std::vector<double> bounds = block_bounds(a, springs);
  CHECK(block_bound(a, springs).omega2 ==
        Approx(*std::max_element(bounds.begin(), bounds.end())).epsilon(1e-13));
}
