#include "tests/support/dem_scene.h"

#include <catch2/catch.hpp>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

enum class Shape { stretch, bend, shear };

Scene spring(Shape shape, double alpha, double kappa)
{
  Scene s;
  s.material.bond = unbreakable_bond();
  section(s.material.bond).kappa = kappa;
  s.motion.damping = alpha;
  const double R = 0.03;
  s.p.add(sphere({-R, 0, 0}, R));
  s.p.add(sphere({R, 0, 0}, R));
  s.bond({{0, 1}});
  const double v = 1e-6;
  ParticleState &i = s.p.state[0], &j = s.p.state[1];
  if (shape == Shape::stretch) {
    i.v.x() = -v;
    j.v.x() = v;
  } else if (shape == Shape::bend) {
    i.omega.z() = -v / R;
    j.omega.z() = v / R;
  } else {
    i.v.y() = -v;
    j.v.y() = v;
    i.omega.z() = j.omega.z() = -v / R;
  }
  return s;
}

/// True if the motion stays bounded over 4000 steps of `factor` times the step at safety 1.
bool is_stable(Shape shape, double alpha, double kappa, double factor)
{
  Scene s = spring(shape, alpha, kappa);
  const StiffnessSums sums = stiffness_sums(s.material, s.cell, s.p, s.bonds, s.contacts);
  const double dt = factor * time_step(sums, s.p, 1.0, {Vec3::Zero(), alpha, false});
  const double before = kinetic_energy(s.p);
  for (int step = 0; step < 4000; ++step) {
    try {
      s.step(dt);
    } catch (const mergel::NumericalError&) {
      return false;
    }
    if (kinetic_energy(s.p) > 1e4 * before) return false;
  }
  return true;
}

/// Largest stable factor by bisection.
double largest(Shape shape, double alpha, double kappa)
{
  double low = 0.3, high = 5.0;
  while (high - low > 1e-3) {
    const double middle = 0.5 * (low + high);
    (is_stable(shape, alpha, kappa, middle) ? low : high) = middle;
  }
  return low;
}

} // namespace

TEST_CASE("The step of safety 1 is the largest stable one of two particles on a spring",
          "[verification][dem]")
{
  // omega^2 = 2 k/m and stability to omega dt = 2: dt = sqrt(2 m/k), the bound itself.
  // With a soft shear spring the normal spring decides alone.
  CHECK(is_stable(Shape::stretch, 0.0, 20.0, 0.999));
  CHECK_FALSE(is_stable(Shape::stretch, 0.0, 20.0, 1.001));
}

TEST_CASE("Bending and shearing of two particles allow more than the step of safety 1",
          "[verification][dem]")
{
  CAPTURE(largest(Shape::bend, 0.0, 2.0), largest(Shape::shear, 0.0, 1.0));
  for (const double kappa : {1.0, 2.0}) {
    CHECK(is_stable(Shape::bend, 0.0, kappa, 0.999));
    CHECK(is_stable(Shape::shear, 0.0, kappa, 0.999));
  }
}

TEST_CASE("The step of safety 1 is stable under local damping too", "[verification][dem]")
{
  for (const double alpha : {0.2, 0.5, 0.7, 0.9}) {
    const double stretch = largest(Shape::stretch, alpha, 20.0);
    CAPTURE(alpha, stretch);
    CHECK(stretch > 0.999);
  }
}
