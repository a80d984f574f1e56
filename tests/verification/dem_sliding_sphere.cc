#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/rigid_wall.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("A sliding sphere rolls after 2 v0/(7 mu g) at 5/7 v0", "[verification][dem]")
{
  // Rigid-body dynamics: v = v0 - mu g t, omega R = 5/2 mu g t, equal at rolling.
  const LinearMaterial law = contact(1e9, 2.0, 0.3, 0.0);
  const double R = 10e-3, g = 9.81, v_0 = 0.5;
  Scene s;
  s.p.add(sphere({0, 0, R}, R));
  ParticleState& b = s.p.state[0];
  const double k_n = law.E * pi * R;
  b.x.z() -= b.m * g / k_n; // at rest on the plane
  b.v.x() = v_0;
  s.motion.gravity = {0.0, 0.0, -g};
  s.motion.free_rotation = true;
  RigidWall plane = make_rigid_wall(Plane{}, Vec3::Zero(), law);
  rebuild_wall(plane, {}, s.p, 1e-3);
  REQUIRE(plane.contacts.size() == 1);
  s.add_more = [&](double dt) { add_wall_forces(plane, {}, dt, s.p, s.losses); };

  const double dt = 0.1 * std::sqrt(b.m / k_n);
  const double t_roll = 2.0 * v_0 / (7.0 * law.mu * g);
  const int n = static_cast<int>(1.5 * t_roll / dt);
  double t_stick = 0.0, v_mean = 0.0, spin_mean = 0.0;
  int n_mean = 0;
  for (int step = 1; step <= n; ++step) {
    s.step(dt);
    const double f_s = plane.contacts[0].f_s.norm();
    if (t_stick == 0.0 && step > 100 && f_s < 0.99 * law.mu * b.m * g) t_stick = step * dt;
    if (step > 0.8 * n) { // the shear spring oscillates: average
      v_mean += b.v.x();
      spin_mean += b.omega.y();
      ++n_mean;
    }
  }
  v_mean /= n_mean;
  spin_mean /= n_mean;
  CAPTURE(t_stick / t_roll, v_mean / v_0, spin_mean * R / v_0);
  CHECK(t_stick == Approx(t_roll).epsilon(1e-3));
  CHECK(v_mean == Approx(5.0 / 7.0 * v_0).epsilon(1e-4));
  CHECK(spin_mean * R == Approx(5.0 / 7.0 * v_0).epsilon(1e-4));
  CHECK(b.x.y() == 0.0);
  // lost: 1/2 m v0^2 - 7/10 m (5/7 v0)^2 = m v0^2/7
  CHECK(s.losses.slip.value() == Approx(b.m * v_0 * v_0 / 7.0).epsilon(1e-3));
}
