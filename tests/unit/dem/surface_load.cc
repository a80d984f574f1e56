// The surcharge on the surface of a specimen, and the constant forces on particles that carry
// it.
#include "dem/specimen/surface_load.h"
#include "dem/error.h"
#include "dem/io/state/assembly_state.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("A surcharge loads the particles that are seen from above, and none below",
          "[unit][dem]")
{
  // Four layers of a cubic packing, the second from above without its middle particle.
  const double d = 1.0, R = 0.5;
  const HalfCylinder region{3.0, 4.0, 8};
  Particles p;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = -2; i < 2; ++i)
        p.add(sphere({(i + 0.5) * d, (j + 0.5) * d, -(k + 0.5) * d}, R));
  const double q = 2e5, area = volume(region) / region.height;
  const std::vector<Vec3> f = surface_load(p, region, q);
  REQUIRE(f.size() == p.size());
  double sum = 0.0, of_top = 0.0;
  for (Index i = 0; i < p.size(); ++i) {
    CHECK(f[i].x() == 0.0);
    CHECK(f[i].y() == 0.0);
    CHECK(f[i].z() <= 0.0);
    sum -= f[i].z();
    if (p.state[i].x.z() > -d) of_top -= f[i].z();
  }
  CHECK(sum == Approx(q * area).epsilon(1e-12));
  CHECK(of_top == Approx(sum).epsilon(1e-12)); // the lower ones are covered
  // All particles of the layer are seen alike.
  for (Index i = 0; i < 8; ++i) CHECK(f[i].z() == Approx(-sum / 8.0).epsilon(1e-12));
  // Mirror images in x have the same bits.
  CHECK(f[0].z() == f[3].z());
}

TEST_CASE("A surcharge reaches a lower particle through a gap of the layer above it",
          "[unit][dem]")
{
  const Cylinder region{2.0, 4.0, 24};
  Particles p;
  p.add(sphere({-0.8, 0.0, -0.6}, 0.6));
  p.add(sphere({0.8, 0.0, -2.4}, 0.6));
  const std::vector<Vec3> f = surface_load(p, region, 1.0);
  CHECK(f[0].z() < 0.0);
  CHECK(f[1].z() == Approx(f[0].z()).epsilon(1e-12));
}

TEST_CASE("A periodic box has no surface for a surcharge", "[unit][dem]")
{
  Particles p;
  p.add(sphere(Vec3::Zero(), 1.0));
  CHECK_THROWS_AS(surface_load(p, PeriodicBox{{3.0, 3.0, 3.0}}, 1.0), mergel::InputError);
}

TEST_CASE("A constant force accelerates a particle by F/m, and its work is F u",
          "[unit][dem]")
{
  Scene s;
  s.p.add(sphere(Vec3::Zero(), 1e-3));
  const Vec3 F(1e-3, 0.0, -2e-3);
  s.p.applied_force = {F};
  const double dt = 4e-5;
  s.start(dt);
  for (int k = 0; k < 99; ++k) s.step(dt);
  const double t = 100 * dt;
  CHECK((s.p.state[0].x - 0.5 * t * t * F / s.p.state[0].m).norm() <
        1e-12 * s.p.state[0].x.norm());
  // The kinetic energy is that of the velocity half a step before, the work that of the kicks.
  CHECK(s.work.gravity.value() ==
        Approx(0.5 * s.p.state[0].m * s.p.state[0].v.squaredNorm()).epsilon(1e-12));
  // A support in the opposite direction leaves no resultant.
  s.p.load[0].f = -F;
  CHECK(sum_of_resultants(s.p, s.motion).value() == 0.0);
}

TEST_CASE("The constant forces survive a checkpoint; a file without them has none",
          "[unit][dem]")
{
  Scene s;
  s.p.add(sphere(Vec3::Zero(), 1e-3));
  s.p.add(sphere({3e-3, 0.0, 0.0}, 1e-3));
  Assembly a = assembly_of(s);
  State plain(0);
  save(plain, a);
  a.particles.applied_force = {{1.0, 2.0, 3.0}, {0.0, 0.0, -4.0}};
  State state(0);
  save(state, a);
  Assembly other = assembly_of(s);
  load(state, other);
  CHECK(other.particles.applied_force == a.particles.applied_force);
  load(plain, other);
  CHECK(other.particles.applied_force.empty());
}
