#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/rigid_wall.h"
#include "dem/walls/triangulated.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 0.2e-3;
const LinearMaterial law = contact(1e9, 2.0, 0.0, 0.0);

/// Diameter 1.4 mm, cone of 60 degrees.
const Revolution exact_shape = cone_ended(0.7e-3, 0.7e-3 * std::sqrt(3.0));

/// The surface with n chords around it, each corner on the true surface.
Wall wall_of_triangles(const Revolution& s, int n)
{
  std::vector<Vec3> x{{0, 0, 0}};
  const auto ring = [&](double r, double z) {
    for (int k = 0; k < n; ++k) {
      const double phi = 2.0 * pi * k / n;
      x.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
  };
  ring(0.5 * s.R(), 0.5 * s.tip_height());
  ring(s.R(), s.tip_height());
  ring(s.R(), s.tip_height() + 1e-3);
  ring(s.R(), s.tip_height() + 2e-3);
  std::vector<Triangle> triangles;
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    triangles.push_back({0, 1 + next, 1 + k}); // normals outwards, to the particles
    for (int row = 0; row < 3; ++row) {
      const int a = 1 + row * n + k, b = 1 + row * n + next;
      triangles.push_back({a, b, b + n});
      triangles.push_back({a, b + n, a + n});
    }
  }
  return make_wall(x, triangles, law);
}

/// Largest difference of the forces on particles pressed into cone and shaft by 0.05 R,
/// relative to the force.
double largest_error(int n)
{
  const Revolution& s = exact_shape;
  Wall wall = wall_of_triangles(s, n);
  Particles exact;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double phi = 2.0 * pi * u(random), reach = 0.95 * R;
    double r = s.R() + reach, z = s.tip_height() + 0.1e-3 + 1.5e-3 * u(random);
    if (k % 2 == 0) {
      const double t = 0.3 + 0.6 * u(random), c30 = std::sqrt(3.0) / 2.0;
      r = t * s.R() + reach * c30;
      z = t * s.tip_height() - 0.5 * reach;
    }
    exact.add(sphere({r * std::cos(phi), r * std::sin(phi), z}, R));
  }
  Particles meshed = exact;
  RigidWall rigid = make_rigid_wall(s, Vec3::Zero(), law);
  rebuild_wall(rigid, {}, exact, 1e-4);
  rebuild_wall(wall, {}, meshed, 1e-4);
  PairLosses losses;
  add_wall_forces(rigid, {}, 0.0, exact, losses);
  add_wall_forces(wall, {}, 0.0, meshed, losses);
  double worst = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, std::abs(exact.load[i].f.norm() - meshed.load[i].f.norm()) /
                                exact.load[i].f.norm());
  return worst;
}

/// Depth of the chord below the arc [m].
double sagitta(int n)
{
  return exact_shape.R() * (1.0 - std::cos(pi / n));
}

} // namespace

TEST_CASE("A triangulated body of revolution has the force of the exact one to second "
          "order in the chord",
          "[unit][dem]")
{
  const double e_100 = largest_error(100), e_200 = largest_error(200),
               e_400 = largest_error(400);
  CAPTURE(e_100, e_200, e_400);
  // The gap differs by at most the sagitta, the overlap is 0.05 R = 10 um.
  CHECK(e_100 < 1.05 * sagitta(100) / 10e-6);
  CHECK(e_400 < 1.05 * sagitta(400) / 10e-6);
  CHECK(e_100 / e_200 == Approx(4.0).epsilon(0.15));
  CHECK(e_200 / e_400 == Approx(4.0).epsilon(0.15));
}

TEST_CASE("A particle at the shoulder of a triangulated surface has one contact force",
          "[unit][dem]")
{
  // The shoulder is a ridge of 30 degrees, the limit of one smooth patch.
  const Revolution& s = exact_shape;
  Wall wall = wall_of_triangles(s, 200);
  Particles p;
  const double a = 0.95 * R, c15 = std::cos(pi / 12.0), s15 = std::sin(pi / 12.0);
  p.add(sphere({s.R() + a * c15, 0.0, s.tip_height() - a * s15}, R)); // before the ridge
  rebuild_wall(wall, {}, p, 1e-4);
  PairLosses losses;
  add_wall_forces(wall, {}, 0.0, p, losses);
  CHECK(p.load[0].f.norm() == Approx(law.E * pi * R * 0.05 * R).epsilon(1e-3));
}
