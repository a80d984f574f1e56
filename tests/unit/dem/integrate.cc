#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <limits>

using namespace mergel::dem;
using namespace mergel::dem::test;
using mergel::match::Contains;

TEST_CASE("A particle that moves more than R/5 in a step stops the run", "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-2));
  p.add(sphere({1, 0, 0}, 1e-2));
  p.state[1].v = {0.0, 1.999, 0.0};
  CHECK_NOTHROW(drift(p, 1e-3));
  p.state[1].v = {0.0, 2.001, 0.0};
  CHECK_THROWS_AS(drift(p, 1e-3), mergel::NumericalError);
  CHECK_THROWS_WITH(drift(p, 1e-3), Contains("particle 1"));
  p.state[1].v = {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  CHECK_THROWS_AS(drift(p, 1e-3), mergel::NumericalError);
}

TEST_CASE("Only a particle with an intact bond spins, unless rotation is free",
          "[unit][dem]")
{
  Particles p;
  for (int k = 0; k < 2; ++k) {
    p.add(sphere({0.1 * k, 0, 0}, 1e-2));
    p.state.back().omega = {0.0, 3.0, 0.0};
    p.load.back().t = {0.0, 1e-5, 0.0};
  }
  p.n_bonds[1] = 1;
  const double I = p.state[0].inertia(), dt = 1e-4;
  KickWork work;
  Motion motion;
  motion.damping = 0.0;
  kick(p, motion, dt, work);
  CHECK(p.state[0].omega == Vec3::Zero());
  CHECK(p.state[1].omega.y() == Approx(3.0 + dt * 1e-5 / I));
  // rotation-constraint loss
  CHECK(work.rotation_constraint.value() == Approx(0.5 * I * 9.0).epsilon(1e-9));

  motion.free_rotation = true;
  kick(p, motion, dt, work);
  CHECK(p.state[0].omega.y() == Approx(dt * 1e-5 / I));
}

TEST_CASE("Damping opposes each component of the velocity, and its loss is counted",
          "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-2));
  ParticleState& b = p.state[0];
  b.v = {0.1, -0.1, 0.0};
  p.load[0].f = {1e-2, 1e-2, 1e-2};
  KickWork work;
  Motion motion;
  motion.damping = 0.7;
  const double before = kinetic_energy(p), dt = 1e-3;
  const Vec3 v_old = b.v;
  kick(p, motion, dt, work);
  const double dv = dt * 1e-2 / b.m;
  CHECK(b.v.x() == Approx(0.1 + 0.3 * dv));
  CHECK(b.v.y() == Approx(-0.1 + 1.7 * dv));
  CHECK(b.v.z() == Approx(dv)); // a velocity of zero is not damped
  CHECK(work.damping.value() > 0.0);
  const double input = dt * p.load[0].f.dot(0.5 * (v_old + b.v));
  CHECK(kinetic_energy(p) - before == Approx(input - work.damping.value()).epsilon(1e-9));
}

TEST_CASE("Without any stiffness the time step has no limit", "[unit][dem]")
{
  Scene s;
  s.p.add(sphere({0, 0, 0}, 1e-2));
  s.motion.damping = 0.7;
  CHECK(stable_time_step(s, 0.7) == std::numeric_limits<double>::infinity());
}

TEST_CASE(
    "The inertia factor slows spins and keeps the energy balance; translations do not "
    "know it",
    "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-2));
  p.load[0].f = {1e-2, 0.0, 0.0};
  p.load[0].t = {0.0, 2e-5, 0.0};
  Motion motion;
  motion.damping = 0.0;
  motion.free_rotation = true;
  motion.inertia_factor = 3.0;
  KickWork work;
  const double dt = 1e-3;
  kick(p, motion, dt, work);
  const ParticleState& b = p.state[0];
  CHECK(b.v.x() == Approx(dt * 1e-2 / b.m));
  CHECK(b.omega.y() == Approx(dt * 2e-5 / (3.0 * b.inertia())));
  const double spin = 0.5 * dt * 2e-5 * b.omega.y(); // work of the torque
  const double moving = 0.5 * b.m * b.v.squaredNorm();
  CHECK(kinetic_energy(p, motion) == Approx(moving + spin));
  motion.free_rotation = false; // the spin that is lost is that energy
  kick(p, motion, dt, work);
  CHECK(work.rotation_constraint.value() == Approx(spin));
}

TEST_CASE("A particle that turns more than 0.2 rad in a step stops the run and is named",
          "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-3));
  p.state[0].omega = {0.0, 1999.0, 0.0};
  CHECK_NOTHROW(drift(p, 1e-4));
  p.state[0].omega = {0.0, 2001.0, 0.0};
  CHECK_THROWS_WITH(drift(p, 1e-4), mergel::match::Contains("particle 0 turns by 0.2001"));
  p.state[0].omega.x() = std::nan("");
  CHECK_THROWS_AS(drift(p, 1e-4), mergel::NumericalError);
}

TEST_CASE("A position that is not a number stops the run, also with contacts alone",
          "[unit][dem]")
{
  // Two particles in contact, without a bond: the filter of the contacts must not drop the
  // pair.
  Scene s;
  s.material.contact = contact(50e6, 2.0, 0.3, 1e-3);
  s.p.add(sphere({0, 0, 0}, 0.03));
  s.p.add(sphere({0.06, 0, 0}, 0.03));
  s.add_contacts({{0, 1}});
  s.p.state[1].x.y() = std::nan("");
  const auto two_steps = [&] {
    s.start(1e-6);
    s.step(1e-6);
  };
  CHECK_THROWS_AS(two_steps(), mergel::NumericalError);
}
