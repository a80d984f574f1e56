#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Mean period of an oscillation that starts upwards from zero, from its upward zeros.
template <class Quantity>
double period(Scene& s, double dt, int n_periods, Quantity&& quantity)
{
  double before = 0.0, first = 0.0, last = 0.0;
  int zeros = 0;
  s.start(dt);
  for (int step = 1; zeros <= n_periods; ++step) {
    const double now = quantity();
    if (step > 1 && before < 0.0 && now >= 0.0) {
      last = dt * (step - now / (now - before));
      if (zeros++ == 0) first = last;
    }
    before = now;
    s.step(dt);
  }
  return (last - first) / n_periods;
}

Scene unequal_pair()
{
  Scene s;
  s.material.bond = unbreakable_bond();
  s.p.add(sphere({-0.03, 0, 0}, 0.03));
  s.p.add(sphere({0.02, 0, 0}, 0.02, 1800.0));
  s.bond({{0, 1}});
  return s;
}

const double R_b = 0.02 / 3.0, A = pi * R_b * R_b, k_n = 400e6 * A / 0.05;

} // namespace

TEST_CASE("A bonded pair stretches at omega^2 = k_n0 A (1/m1 + 1/m2)",
          "[verification][dem]")
{
  Scene s = unequal_pair();
  const ParticleState &i = s.p.state[0], &j = s.p.state[1];
  const double omega = std::sqrt(k_n * (1.0 / i.m + 1.0 / j.m)), dt = 0.02 / omega;
  s.p.state[1].v.x() = 1e-4;
  s.p.state[0].v.x() = -1e-4 * j.m / i.m;
  const double T = period(s, dt, 20, [&] { return j.x.x() - i.x.x() - 0.05; });
  // Leapfrog shortens the period by (omega dt)^2/24 = 1.7e-5.
  CHECK(T * omega / (2.0 * pi) == Approx(1.0 - 0.02 * 0.02 / 24.0).epsilon(1e-6));
}

TEST_CASE("A bonded pair bends at omega^2 = k_b0 (1/I1 + 1/I2)", "[verification][dem]")
{
  Scene s = unequal_pair();
  section(s.material.bond).kappa = 1e12; // no shear, which unequal spins would excite
  const ParticleState &i = s.p.state[0], &j = s.p.state[1];
  const double k_b = k_n * R_b * R_b / 4.0;
  const double omega = std::sqrt(k_b * (1.0 / i.inertia() + 1.0 / j.inertia()));
  const double dt = 0.02 / omega;
  s.p.state[1].omega.z() = 1e-3;
  s.p.state[0].omega.z() = -1e-3 * j.inertia() / i.inertia();
  const double T = period(s, dt, 20, [&] { return s.bonds.blocks[0].M.z[0]; });
  CHECK(T * omega / (2.0 * pi) == Approx(1.0 - 0.02 * 0.02 / 24.0).epsilon(1e-6));
}
