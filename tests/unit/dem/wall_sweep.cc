#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/patch_features.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3;
const LinearMaterial law = contact(1e9, 2.0, 0.3, 2e-5);

/// Two triangles over a square of 10 mm, folded along their diagonal by this angle [rad],
/// up towards the particles (a valley) for positive angles.
Wall folded_square(double angle)
{
  const double a = 10e-3;
  const Vec3 hinge = Vec3(1.0, 1.0, 0.0).normalized();
  const Vec3 corner(0.0, a, 0.0);
  const Vec3 folded_corner = Eigen::AngleAxisd(angle, hinge) * corner;
  return make_wall({{0, 0, 0}, {a, 0, 0}, {a, a, 0}, folded_corner}, {{0, 1, 2}, {0, 2, 3}},
                   law);
}

struct ContactLoad {
  Vec3 f, t;
};

/// Force and torque on a particle at x at the first step of its contact, without friction.
ContactLoad force_at(Wall& wall, const Vec3& x)
{
  Particles p;
  p.add(sphere(x, R));
  PairLosses losses;
  wall.contacts.clear();
  rebuild_wall(wall, {}, p, 1e-4);
  add_wall_forces(wall, {}, 0.0, p, losses);
  return {p.load[0].f, p.load[0].t};
}

/// Largest change of the force in one of n steps along the path, over the largest force.
double largest_jump(Wall& wall, const Vec3& from, const Vec3& to, int n)
{
  double jump = 0.0, largest = 0.0;
  Vec3 before = force_at(wall, from).f;
  for (int k = 1; k <= n; ++k) {
    const Vec3 f = force_at(wall, from + (to - from) * k / n).f;
    jump = std::max(jump, (f - before).norm());
    largest = std::max(largest, f.norm());
    before = f;
  }
  return jump / largest;
}

} // namespace

TEST_CASE("A particle swept over the diagonal of a flat wall has one constant force",
          "[unit][dem]")
{
  Wall wall = folded_square(0.0);
  CHECK(wall.topology.n_patches == 1);
  const double k_n = law.E * pi * R; // r = R, L = R
  for (int k = 0; k <= 1000; ++k) {
    const double s = 1e-3 + 8e-6 * k;
    const Vec3 f = force_at(wall, {s, 9e-3 - s + 0.3e-3, 0.98e-3}).f;
    REQUIRE(std::hypot(f.x(), f.y()) < 1e-12 * f.z());
    REQUIRE(f.z() == Approx(k_n * 4e-5).epsilon(1e-11)); // gap -20 um, g_a 20 um
  }
}

TEST_CASE("A particle exactly over an edge or a node of an inclined wall has one contact",
          "[unit][dem]")
{
  // Round-off decides on which side of the edge a centre over it lies; exactly one of
  // triangle, edge and node must act.
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int lost = 0, doubled = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(u(random), u(random), u(random), u(random)).normalized();
    const double a = 10e-3;
    std::vector<Vec3> x;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) x.push_back(turn * Vec3(a * i, a * j, 0.0));
    std::vector<Triangle> triangles;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const int q = 3 * i + j;
        triangles.push_back({q, q + 3, q + 4});
        triangles.push_back({q, q + 4, q + 1});
      }
    Wall wall = make_wall(x, triangles, law);
    const Vec3 n = normal(wall, 0);
    const bool at_node = trial % 3 == 0;
    const Vec3 foot = at_node ? x[4] : Vec3(x[4] + u(random) * (x[8] - x[4]));
    const double f = force_at(wall, foot + 0.98e-3 * n).f.norm() / (law.E * pi * R * 4e-5);
    lost += f < 0.5;
    doubled += f > 1.5;
  }
  CHECK(lost == 0);
  CHECK(doubled == 0);
}

TEST_CASE("The force on a particle swept over a fold below 30 degrees is continuous",
          "[unit][dem]")
{
  const double degrees = GENERATE(-29.0, -25.0, -5.0, 5.0, 25.0, 29.0);
  CAPTURE(degrees);
  Wall wall = folded_square(degrees * pi / 180.0);
  REQUIRE(wall.topology.n_patches == 1);
  // Across the diagonal at a height of 0.98 R over the first triangle. A jump would not
  // shrink with the step; a continuous force changes by about the step over its range.
  const Vec3 middle(5e-3, 5e-3, 0.0), across = Vec3(1.0, -1.0, 0.0).normalized();
  const Vec3 from = middle + 1e-3 * across, to = middle - 0.02e-3 * across;
  const Vec3 height(0.0, 0.0, 0.98e-3);
  const double coarse = largest_jump(wall, from + height, to + height, 500);
  const double fine = largest_jump(wall, from + height, to + height, 5000);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.2 * coarse + 1e-12);
}

TEST_CASE("A fold beyond 30 degrees separates patches and each side acts on its own",
          "[unit][dem]")
{
  CHECK(folded_square(29.0 * pi / 180.0).topology.n_patches == 1);
  CHECK(folded_square(31.0 * pi / 180.0).topology.n_patches == 2);

  // In a right-angled valley the particle touches both sides.
  Wall wall = folded_square(pi / 2.0);
  REQUIRE(wall.topology.n_patches == 2);
  const Vec3 n_0 = normal(wall, 0), n_1 = normal(wall, 1);
  REQUIRE(n_0.dot(n_1) == Approx(0.0).margin(1e-12));
  const Vec3 x = Vec3(5e-3, 5e-3, 0.0) + 0.97e-3 * n_0 + 0.99e-3 * n_1;
  const Vec3 f = force_at(wall, x).f;
  const double k_n = law.E * pi * R;
  CHECK(f.dot(n_0) == Approx(k_n * 5e-5).epsilon(1e-9));
  CHECK(f.dot(n_1) == Approx(k_n * 3e-5).epsilon(1e-9));
}

TEST_CASE("Force, moment and power at the nodes balance those on the particle",
          "[unit][dem]")
{
  const double degrees = GENERATE(0.0, 15.0, -15.0);
  Wall wall = folded_square(degrees * pi / 180.0);
  std::mt19937_64 random(3);
  PatchFeatures features;
  double worst_force = 0.0, worst_moment = 0.0, worst_power = 0.0;
  int n_in_contact = 0, n_shared = 0, n_separate = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Particles p;
    Vec3 x = Vec3(5e-3, 5e-3, 0.97e-3) + 4e-4 * random_vector(random);
    x.z() = 1e-3 - 1e-5 * trial / 2000.0;
    p.add(sphere(x, R));
    p.state[0].v = 0.1 * random_vector(random);
    p.state[0].omega = 1e2 * random_vector(random);
    for (Vec3& v : wall.v) v = 1e-3 * random_vector(random);
    wall.contacts.clear();
    rebuild_wall(wall, {}, p, 1e-4);
    features.find(wall, wall.listed.at(0), p.state[0], 0.0);
    const std::vector<PatchFeature>& found = features.found();
    if (found.empty()) continue;
    n_shared += found.size() > 1;
    double signs = 0.0;
    for (const PatchFeature& f : found) signs += f.sign;
    // The sides of a valley act each by itself where the edge is out of reach.
    const bool separate = signs == 2.0 && found.size() == 2;
    CHECK((signs == 1.0 || (separate && degrees > 0.0)));
    n_separate += separate;
    PairLosses losses;
    add_wall_forces(wall, {}, 1e-6, p, losses);
    const Vec3 on_particle = p.load[0].f;
    if (on_particle.norm() < 1.0)
      continue; // barely touching: the quantum of the sums is not negligible
    ++n_in_contact;
    Vec3 force = on_particle, moment = x.cross(on_particle) + p.load[0].t;
    double power = 0.0;
    for (std::size_t node = 0; node < wall.x.size(); ++node) {
      const Vec3 f = wall.f.value(node);
      force += f;
      moment += wall.x[node].cross(f);
      power += f.dot(wall.v[node]);
    }
    worst_force = std::max(worst_force, force.norm() / on_particle.norm());
    worst_moment = std::max(worst_moment, moment.norm() / (on_particle.norm() * R));
    worst_power =
        std::max(worst_power, std::abs(power - sum_contact_forces(wall).power.value()) /
                                  on_particle.norm());
  }
  CAPTURE(degrees, n_shared, n_separate);
  CHECK(n_in_contact > 500);
  // The arm is the exact vector to the shared point, so only round-off and the quantum
  // 9e-16 N remain.
  CHECK(worst_force < 1e-12);
  CHECK(worst_moment < 1e-12);
  CHECK(worst_power < 1e-12);
}

TEST_CASE("A centre on the wrong side of a wall stops the run", "[unit][dem]")
{
  Wall wall = folded_square(0.0);
  CHECK_NOTHROW(force_at(wall, {3e-3, 5e-3, 0.1e-3}));
  CHECK_THROWS_AS(force_at(wall, {3e-3, 5e-3, -0.1e-3}), mergel::NumericalError);
  CHECK_THROWS_AS(force_at(wall, {3e-3, 5e-3, -0.9e-3}), mergel::NumericalError);
  CHECK_THROWS_AS(force_at(wall, {5e-3, 5e-3, -0.5e-3}),
                  mergel::NumericalError); // at the edge

  // Behind the tip of a pit, which is nearer than its faces.
  std::vector<Vec3> x{Vec3::Zero()};
  std::vector<Triangle> triangles;
  for (int k = 0; k < 6; ++k) {
    const double a = k * pi / 3.0;
    x.push_back({3e-3 * std::cos(a), 3e-3 * std::sin(a), 0.3e-3});
    triangles.push_back({0, 1 + k, 1 + (k + 1) % 6});
  }
  Wall pit = make_wall(x, triangles, law);
  REQUIRE(pit.topology.n_patches == 1);
  CHECK_NOTHROW(force_at(pit, {0.0, 0.0, 0.1e-3}));
  CHECK_THROWS_AS(force_at(pit, {0.0, 0.0, -0.1e-3}), mergel::NumericalError);
  CHECK_NOTHROW(force_at(pit, {3.01e-3, 0.0, 0.2e-3})); // beside the boundary
}

TEST_CASE("Triangles that do not form a wall are refused", "[unit][dem]")
{
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  CHECK_NOTHROW(make_topology(x, {{0, 1, 2}, {0, 2, 3}}));
  CHECK_THROWS_AS(make_topology(x, {{0, 1, 5}}), mergel::InputError);
  CHECK_THROWS_AS(make_topology(x, {{0, 1, -1}}), mergel::InputError);
  CHECK_THROWS_AS(make_topology(x, {{0, 1, 4}}), mergel::InputError); // on one line
  CHECK_THROWS_AS(make_topology(x, {{0, 1, 2}, {0, 3, 2}, {0, 2, 4}}), mergel::InputError);
  CHECK_THROWS_AS(make_topology(x, {{0, 1, 2}, {2, 0, 3}, {2, 0, 4}}), mergel::InputError);
}
