#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/rigid_wall.h"
#include "dem/walls/triangulated.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3;

/// Moves and rotates one particle along a fixed path of a few thousand steps.
void move_along_path(ParticleState& b, int step)
{
  const double t = 1e-3 * step;
  b.v = {3.0 * std::cos(3 * t), 3.0 * std::cos(5 * t), 0.05 * std::cos(20 * t)};
  b.omega = 1e3 * Vec3(std::sin(7 * t), std::sin(2 * t), std::cos(t));
  b.x += 1e-6 * b.v;
}

} // namespace

TEST_CASE("A plane and the same plane of triangles have the same contact force",
          "[unit][dem]")
{
  const LinearMaterial law = contact(1e8, 2.0, 0.3, 1e-5);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Vec3(0.6, 0.8, 0.0)));
  const Vec3 n = turn * Vec3::UnitZ();
  const Vec3 v_wall(1e-3, 2e-3, -3e-3);

  RigidWall plane = make_rigid_wall(Plane{n}, Vec3::Zero(), law);
  plane.v = v_wall;
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      x.push_back(turn * Vec3(2e-3 * (i - 4), 2e-3 * (j - 4), 0.0));
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const int q = 9 * i + j;
      triangles.push_back({q, q + 9, q + 10});
      triangles.push_back({q, q + 10, q + 1});
    }
  Wall wall = make_wall(x, triangles, law);
  wall.v.assign(x.size(), v_wall);

  Particles one, two;
  one.add(sphere(0.99 * R * n, R));
  two.add(sphere(0.99 * R * n, R));
  rebuild_wall(plane, {}, one, 1e-3);
  REQUIRE(plane.contacts.size() == 1);
  PairLosses losses_1, losses_2;
  double worst = 0.0, largest = 0.0;
  for (int step = 0; step < 3000; ++step) {
    move_along_path(one.state[0], step);
    move_along_path(two.state[0], step);
    clear_loads(one);
    clear_loads(two);
    rebuild_wall(wall, {}, two, 1e-4);
    add_wall_forces(plane, {}, 1e-6, one, losses_1);
    const Vec3 on_plane = plane.resultant();
    add_wall_forces(wall, {}, 1e-6, two, losses_2);
    worst = std::max(worst, (one.load[0].f - two.load[0].f).norm());
    worst = std::max(worst, (one.load[0].t - two.load[0].t).norm() / R);
    worst = std::max(worst, (on_plane + one.load[0].f).norm());
    largest = std::max(largest, one.load[0].f.norm());
  }
  CHECK(largest > 1.0);
  CHECK(worst <
        1e-9 * largest); // round-off of gaps of 1e-5 at positions of 1e-3: 1e-13 to 1e-11
  CHECK(losses_1.slip.value() > 0.0);
  CHECK(losses_1.slip.value() == Approx(losses_2.slip.value()).epsilon(1e-9));
}

TEST_CASE("A plane acts along its normal, and a particle behind it stops the run",
          "[unit][dem]")
{
  const LinearMaterial law = contact(1e9, 2.0, 0.3, 1e-5);
  RigidWall plane = make_rigid_wall(Plane{}, {0, 0, 5e-3}, law);
  Particles p;
  p.add(sphere({1e-3, 2e-3, 5.995e-3}, R));
  p.add(sphere({9e-3, 2e-3, 9e-3}, R));
  rebuild_wall(plane, {}, p, 1e-4);
  REQUIRE(plane.contacts.size() == 1);
  plane.x.z() += 2e-7;
  CHECK(travel(plane) == Approx(2e-7).epsilon(1e-9));
  plane.x.z() -= 2e-7;
  PairLosses losses;
  add_wall_forces(plane, {}, 0.0, p, losses);
  const Vec3 on_plane = plane.resultant();
  CHECK(p.load[0].f.z() == Approx(1e9 * pi * R * 1.5e-5).epsilon(1e-9));
  CHECK(p.load[0].t.norm() < 1e-15);
  CHECK(on_plane.z() == Approx(-p.load[0].f.z()).epsilon(1e-14));
  CHECK(stored_energy(plane, p).value() ==
        Approx(0.5 * 1e9 * pi * R * 1.5e-5 * 1.5e-5).epsilon(1e-9));

  p.state[0].x.z() = 4.999e-3;
  CHECK_THROWS_AS(add_wall_forces(plane, {}, 0.0, p, losses), mergel::NumericalError);
}
