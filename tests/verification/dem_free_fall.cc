#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("Under local damping a particle falls with g (1 - alpha)", "[verification][dem]")
{
  Scene s;
  s.p.add(sphere({0, 0, 0}, 0.1));
  s.motion.gravity = {0.0, 0.0, -9.81};
  s.motion.damping = 0.7;
  const double dt = 1e-4;
  s.p.state[0].v.z() = -1e-9; // a velocity of exactly zero is not damped
  for (int k = 0; k < 10000; ++k) s.step(dt);
  CHECK(s.p.state[0].v.z() == Approx(-9.81 * 0.3 * 1.0).epsilon(1e-8));
  CHECK(s.p.state[0].v.x() == 0.0);

  // While it rises it decelerates with g (1 + alpha).
  s.p.state[0].v.z() = 5.0;
  for (int k = 0; k < 1000; ++k) s.step(dt);
  CHECK(s.p.state[0].v.z() == Approx(5.0 - 9.81 * 1.7 * 0.1).epsilon(1e-10));
}

TEST_CASE("Leapfrog is of second order", "[verification][dem]")
{
  // Two bonded particles on their normal spring: gap - gap_0 = a sin(omega t).
  const auto error = [](int n) {
    Scene s;
    s.material.bond = unbreakable_bond();
    const double R = 0.03, a = 1e-5;
    s.p.add(sphere({-R, 0, 0}, R));
    s.p.add(sphere({R, 0, 0}, R));
    s.bond({{0, 1}});
    const double k = 400e6 * pi * R * R / 9.0 / (2.0 * R), m = s.p.state[0].m;
    const double omega = std::sqrt(2.0 * k / m), t = 7.3 / omega, dt = t / n;
    s.p.state[1].v.x() = 0.5 * a * omega;
    s.p.state[0].v.x() = -0.5 * a * omega;
    s.start(dt);
    for (int step = 1; step < n; ++step) s.step(dt);
    const double stretch = s.p.state[1].x.x() - s.p.state[0].x.x() - 2.0 * R;
    return std::abs(stretch - a * std::sin(omega * t)) / a;
  };
  const double e_100 = error(100), e_200 = error(200), e_400 = error(400);
  CAPTURE(e_100, e_200, e_400);
  CHECK(e_100 / e_200 == Approx(4.0).epsilon(0.02));
  CHECK(e_200 / e_400 == Approx(4.0).epsilon(0.02));
}
