#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

struct Impact {
  double duration, onset, restitution; ///< [s], gap at the first force [m], [-]
};

/// Two unequal particles collide head-on at 0.2 m/s with n steps per theoretical duration.
Impact collide(int n)
{
  Scene s;
  s.material.contact = contact(50e6, 2.0, 0.0, 1e-3);
  s.p.add(sphere({0, 0, 0}, 0.03));
  s.p.add(sphere({0.0525, 0, 0}, 0.02)); // gap 2.5 mm
  s.p.state[0].v = {0.1, 0, 0};
  s.p.state[1].v = {-0.1, 0, 0};
  s.add_contacts({{0, 1}});
  const double m_star = 1.0 / (1.0 / s.p.state[0].m + 1.0 / s.p.state[1].m);
  const double k_n = 50e6 * pi * 0.02 * 0.02 / 0.05;
  const double T = pi * std::sqrt(m_star / k_n), dt = T / n;
  const auto gap = [&] { return (s.p.state[1].x - s.p.state[0].x).norm() - 0.05; };

  double t_in = 0.0, t_out = 0.0, onset = 0.0, before = gap();
  for (int step = 1; t_out == 0.0 && step < 1000 * n; ++step) {
    s.step(dt);
    const double now = gap(), g_a = 1e-3, t = step * dt;
    const double crossing = t - dt * (now - g_a) / (now - before);
    if (before >= g_a && now < g_a) t_in = crossing;
    if (before < g_a && now >= g_a) t_out = crossing;
    if (onset == 0.0 && s.p.load[0].f.x() != 0.0) onset = before;
    before = now;
  }
  s.forces(dt); // apart
  REQUIRE(s.p.load[0].f.norm() == 0.0);
  const double v = s.p.state[1].v.x() - s.p.state[0].v.x();
  return {(t_out - t_in) / T, onset, v / 0.2};
}

} // namespace

TEST_CASE("A head-on collision lasts pi sqrt(m*/k_n) and returns all speed",
          "[verification][dem]")
{
  const Impact i = collide(1000), j = collide(2000);
  CAPTURE(i.duration, j.duration, i.restitution, j.restitution);
  // Leapfrog changes the period by (omega dt)^2/24 = 4e-7; the instant of the first contact
  // within its step adds (pi/n)^2.
  CHECK(i.duration == Approx(1.0).epsilon(1e-5));
  CHECK(i.restitution == Approx(1.0).epsilon(1e-5));
  CHECK(j.restitution == Approx(1.0).epsilon(3e-6));
  // The first force comes within one step (0.2 m/s) of gap = g_a.
  CHECK(i.onset <= 1e-3);
  CHECK(i.onset > 1e-3 - 1e-6);
}
