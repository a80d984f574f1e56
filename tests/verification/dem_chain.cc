#include "tests/dem_scene.h"

#include <catch2/catch.hpp>

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("A chain of bonded spheres swings at omega = 2 sqrt(k/m) sin(kappa d/2)",
          "[verification][dem]")
{
  // Born and von Karman (1912): standing wave of wave number kappa = 2 pi j/(n d) on a
  // periodic chain.
  const int n = 24;
  const double R = 0.03, d = 2.0 * R;
  for (const int j : {1, 4, 8, 12}) {
    Scene s;
    s.material.bond = unbreakable_bond();
    s.cell.size = {n * d, 0.0, 0.0};
    std::vector<Pair> pairs;
    const double kappa = 2.0 * pi * j / (n * d);
    for (Index i = 0; i < n; ++i) {
      s.p.add(sphere({d * i, 0, 0}, R));
      s.p.body[i].v.x() = 1e-3 * std::cos(kappa * d * i);
      if (i + 1 < n) pairs.push_back({i, i + 1});
    }
    pairs.insert(pairs.begin() + 1, {0, n - 1, {-1, 0, 0}});
    s.bond(pairs);
    const double k = 400e6 * pi * R * R / 9.0 / d, m = s.p.body[0].m;
    const double omega = 2.0 * std::sqrt(k / m) * std::sin(0.5 * kappa * d);
    const double dt = 0.02 / omega;
    s.start(dt);
    double before = 1.0, first = 0.0, last = 0.0;
    int zeros = 0;
    for (int step = 1; zeros <= 8; ++step) {
      s.step(dt);
      double v = 0.0; // amplitude of the mode at t = step dt + dt/2
      for (Index i = 0; i < n; ++i) v += s.p.body[i].v.x() * std::cos(kappa * d * i);
      if (before < 0.0 && v >= 0.0) {
        last = dt * (step - v / (v - before));
        if (zeros++ == 0) first = last;
      }
      before = v;
    }
    CAPTURE(j);
    // less the leapfrog's (omega dt)^2/24
    CHECK((last - first) / 8.0 * omega / (2.0 * pi) ==
          Approx(1.0 - 0.02 * 0.02 / 24.0).epsilon(1e-6));
    CHECK(s.p.body[3].v.y() == 0.0);
    CHECK(s.p.body[3].omega.norm() == 0.0);
  }
}
