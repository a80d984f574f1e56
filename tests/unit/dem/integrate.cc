#include "tests/support/dem_scene.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace mergel::dem;
using namespace mergel::dem::test;
using Catch::Matchers::Contains;

TEST_CASE("A particle that moves a twentieth of its radius in a step stops the run",
          "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-2));
  p.add(sphere({1, 0, 0}, 1e-2));
  p.body[1].v = {0.0, 0.499, 0.0};
  CHECK_NOTHROW(drift(p, 1e-3));
  p.body[1].v = {0.0, 0.501, 0.0};
  CHECK_THROWS_AS(drift(p, 1e-3), mergel::NumericalError);
  CHECK_THROWS_WITH(drift(p, 1e-3), Contains("particle 1"));
  p.body[1].v = {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  CHECK_THROWS_AS(drift(p, 1e-3), mergel::NumericalError);
}

TEST_CASE("Only a particle with a living bond spins, unless all may", "[unit][dem]")
{
  Particles p;
  for (int k = 0; k < 2; ++k) {
    p.add(sphere({0.1 * k, 0, 0}, 1e-2));
    p.body.back().omega = {0.0, 3.0, 0.0};
    p.load.back().t = {0.0, 1e-5, 0.0};
  }
  p.n_bonds[1] = 1;
  const double I = p.body[0].inertia(), dt = 1e-4;
  KickWork work;
  Motion motion;
  motion.damping = 0.0;
  kick(p, motion, dt, work);
  CHECK(p.body[0].omega == Vec3::Zero());
  CHECK(p.body[1].omega.y() == Approx(3.0 + dt * 1e-5 / I));
  CHECK(work.lock.value() == Approx(0.5 * I * 9.0).epsilon(1e-9)); // on the ledger

  motion.free_rotation = true;
  kick(p, motion, dt, work);
  CHECK(p.body[0].omega.y() == Approx(dt * 1e-5 / I));
}

TEST_CASE("Damping opposes each component of the velocity and books what it takes",
          "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-2));
  Body& b = p.body[0];
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
  CHECK(b.v.z() == Approx(dv)); // at rest there is nothing to oppose
  CHECK(work.damping.value() > 0.0);
  const double input = dt * p.load[0].f.dot(0.5 * (v_old + b.v));
  CHECK(kinetic_energy(p) - before == Approx(input - work.damping.value()).epsilon(1e-9));
}

TEST_CASE("Without any stiffness there is no limit to the step", "[unit][dem]")
{
  Scene s;
  s.p.add(sphere({0, 0, 0}, 1e-2));
  const StiffnessSums sums = stiffness_sums(s.material, s.cell, s.p, s.bonds, s.contacts);
  CHECK(time_step(sums, s.p, 0.7, {Vec3::Zero(), 0.7, false}) ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("A grain that spins more than 0.05 rad in a step stops the run, and names itself",
          "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1e-3));
  p.body[0].omega = {0.0, 499.0, 0.0};
  CHECK_NOTHROW(drift(p, 1e-4));
  p.body[0].omega = {0.0, 501.0, 0.0};
  CHECK_THROWS_WITH(drift(p, 1e-4), Catch::Contains("particle 0 turns by 0.0501"));
  p.body[0].omega.x() = std::nan("");
  CHECK_THROWS_AS(drift(p, 1e-4), mergel::NumericalError);
}

TEST_CASE("A place that is not a number stops the run, contacts alone included",
          "[unit][dem]")
{
  // Two spheres in contact, without a bond: the filter of those that touch must not drop it.
  Scene s;
  s.material.contact = contact(50e6, 2.0, 0.3, 1e-3);
  s.p.add(sphere({0, 0, 0}, 0.03));
  s.p.add(sphere({0.06, 0, 0}, 0.03));
  s.touch({{0, 1}});
  s.p.body[1].x.y() = std::nan("");
  const auto two_steps = [&] {
    s.start(1e-6);
    s.step(1e-6);
  };
  CHECK_THROWS_AS(two_steps(), mergel::NumericalError);
}
