#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/rigid_wall.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// A pile of 1.4 mm with a cone of 60 degrees, at rest.
RigidWall pile()
{
  RigidWall wall = make_rigid_wall(cone_ended(0.7e-3, 0.7e-3 * std::sqrt(3.0)),
                                   Vec3(1e-3, 2e-3, -3e-3), contact(1e9, 2.4, 0.2, 0.0));
  wall.reach = 10e-3;
  return wall;
}

const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3(1.0, 2.0, -0.5).normalized()));
const Vec3 shift(0.4e-3, -0.2e-3, 0.1e-3);

/// The point where a rigid motion by `turn` about the wall's origin and by `shift` takes it.
Vec3 moved(const Vec3& point, const Vec3& origin)
{
  return origin + shift + turn * (point - origin);
}

} // namespace

TEST_CASE("A wall that moves with its particles as one rigid body sees them alike",
          "[unit][dem]")
{
  RigidWall wall = pile();
  std::mt19937_64 random(3);
  for (int k = 0; k < 200; ++k) {
    wall = pile();
    Vec3 at = random_vector(random) * 2e-3 + wall.x;
    if (std::hypot(at.x() - wall.x.x(), at.y() - wall.x.y()) < 0.75e-3)
      at.z() = wall.x.z() - 0.1e-3; // outside
    ParticleState b = sphere(at, 0.2e-3);
    const SurfacePoint before = closest_point(wall, b);
    b.x = moved(b.x, wall.x);
    const Vec3 origin = wall.x;
    wall.x += shift;
    wall.rotation = turn;
    const SurfacePoint after = closest_point(wall, b);
    CHECK(after.part == before.part);
    CHECK(after.gap == Approx(before.gap).margin(1e-15));
    CHECK((after.n - turn * before.n).norm() < 1e-12);
    CHECK((after.point - moved(before.point, origin)).norm() < 1e-15);
  }
}

TEST_CASE("The power of a wall that spins is that of its forces at their points",
          "[unit][dem]")
{
  RigidWall wall = pile();
  wall.rotation = turn;
  wall.v = Vec3(0.3, -0.1, 0.2);
  wall.omega = Vec3(20.0, 50.0, -10.0);
  Particles p;
  std::mt19937_64 random(7);
  for (std::uint64_t k = 0; k < 40; ++k) { // around the shaft, some in contact
    const double phi = 0.157 * static_cast<double>(k), z = 2e-3 + 0.05e-3 * double(k);
    const double r = 0.7e-3 + 0.2e-3 - (k % 2 == 0 ? 0.02e-3 : -0.02e-3);
    const Vec3 at = wall.x + turn * Vec3(r * std::cos(phi), r * std::sin(phi), z);
    p.add(sphere(at, 0.2e-3));
  }
  const PairMaterials material{unbreakable_bond(), contact(1e9, 2.4, 0.2, 0.0)};
  rebuild_wall(wall, material, p, 0.1e-3);
  PairLosses losses;
  add_wall_forces(wall, material, 1e-8, p, losses);

  double expected = 0.0;
  Vec3 sum = Vec3::Zero();
  int n = 0;
  for (std::size_t k = 0; k < p.state.size(); ++k) {
    const Vec3& f = p.load[k].f; // on the particle
    if (f == Vec3::Zero()) continue;
    ++n;
    sum += f;
    expected += f.dot(wall.velocity_at(closest_point(wall, p.state[k]).point));
  }
  REQUIRE(n == 20);
  CHECK((wall.resultant() + sum).norm() < 1e-12 * sum.norm() + 1e-12);
  CHECK(power(wall) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("A wall that turns makes its candidates stale by the motion of its far points",
          "[unit][dem]")
{
  RigidWall wall = pile();
  CHECK(travel(wall) == 0.0);
  wall.rotation = Eigen::AngleAxisd(1e-3, Vec3::UnitY());
  CHECK(travel(wall) == Approx(10e-6).epsilon(1e-9)); // 1 mrad at 10 mm
  wall.x.x() += 5e-6;
  CHECK(travel(wall) == Approx(15e-6).epsilon(1e-9));
}
