#include "tests/dem_scene.h"

#include <catch2/catch.hpp>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Random trials outside the surface and random weights, of conjugate or published
/// proportions.
struct Trials {
  std::mt19937_64 random{2024};
  std::uniform_real_distribution<double> unit{0.0, 1.0};

  double uniform(double low, double high) { return low + (high - low) * unit(random); }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  YieldPoint outside(double reach)
  {
    for (;;) {
      YieldPoint t{uniform(-reach, reach), uniform(0.0, reach), uniform(0.0, reach)};
      if (unit(random) < 0.1) t.m = 0.0; // the edges of the octant too
      if (unit(random) < 0.1) t.v = 0.0;
      if (unit(random) < 0.1) t.n = 0.0;
      if (yield_function(t) > 0.0) return t;
    }
  }
  YieldPoint inside()
  {
    for (;;) {
      const YieldPoint z{uniform(-1.0, 1.0), uniform(0.0, 1.0), uniform(0.0, 1.0)};
      if (yield_function(z) <= 0.0) return z;
    }
  }
  EnergyNorm weights(BendingFlow flow)
  {
    // strength^2/stiffness: 1 to 100 mJ in proportion; Eq. 7 as printed multiplies the last
    // by 1/R_b
    const EnergyNorm w{decades(0, 2), decades(-1, 1), decades(0, 2)};
    return flow == BendingFlow::conjugate ? w : EnergyNorm{w.n, w.v, w.m * decades(3, 5)};
  }
};

} // namespace

TEST_CASE("A trial up to three times outside returns to the surface", "[unit][dem]")
{
  Trials trials;
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  double worst = 0.0;
  bool is_sound = true;
  for (int k = 0; k < 100000; ++k) {
    const YieldPoint t = trials.outside(3.0);
    const YieldPoint y = closest_point(t, trials.weights(flow));
    worst = std::max(worst, std::abs(yield_function(y)));
    is_sound = is_sound && y.n * t.n >= 0.0 && std::abs(y.n) <= std::abs(t.n) &&
               y.v >= 0.0 && y.v <= t.v && y.m >= 0.0 && y.m <= t.m * (1.0 + 1e-12) + 1e-15;
  }
  CAPTURE(static_cast<int>(flow));
  CHECK(worst < 1e-10);
  CHECK(is_sound); // n keeps its sign, nothing grows
}

TEST_CASE("The returned point is the closest one in the energy norm", "[unit][dem]")
{
  // Projection onto a convex set: (t - y) . W (z - y) <= 0 for every z of the set.
  Trials trials;
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  double worst = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const YieldPoint t = trials.outside(3.0);
    const EnergyNorm w = trials.weights(flow);
    const YieldPoint y = closest_point(t, w);
    const double distance =
        std::sqrt(w.n * (t.n - y.n) * (t.n - y.n) + w.v * (t.v - y.v) * (t.v - y.v) +
                  w.m * (t.m - y.m) * (t.m - y.m));
    for (int other = 0; other < 20; ++other) {
      const YieldPoint z = trials.inside();
      const double product = w.n * (t.n - y.n) * (z.n - y.n) +
                             w.v * (t.v - y.v) * (z.v - y.v) +
                             w.m * (t.m - y.m) * (z.m - y.m);
      worst = std::max(worst, product / (distance * std::sqrt(w.n + w.v + w.m)));
    }
  }
  CAPTURE(static_cast<int>(flow));
  CHECK(worst < 1e-10);
}

TEST_CASE("The S-shaped case that makes a plain Newton cycle returns", "[unit][dem]")
{
  // f(mu) bends twice near the tip n = 1: Newton jumps between the two ends of its bracket.
  const YieldPoint t{2.32723, 0.541848, 0.809454};
  const EnergyNorm w{8.94059, 0.987703, 31.123};
  const YieldPoint y = closest_point(t, w);
  CHECK(std::abs(yield_function(y)) < 1e-14);
  Trials trials;
  double worst = -1.0;
  for (int k = 0; k < 1000; ++k) {
    const YieldPoint z = trials.inside();
    worst =
        std::max(worst, w.n * (t.n - y.n) * (z.n - y.n) + w.v * (t.v - y.v) * (z.v - y.v) +
                            w.m * (t.m - y.m) * (z.m - y.m));
  }
  CHECK(worst < 1e-10);
}

TEST_CASE("Tension and bending without shear return past the tip n = 1", "[unit][dem]")
{
  // With v = 0 the tip n = 1 has a fan of normals: every h from 0 to 1 belongs to it.
  const YieldPoint t{2.142330124281687, 0.0, 1.4791454572125016};
  const EnergyNorm w{61.042307087513819, 6.465981981781991, 23.332726482740245};
  const YieldPoint y = closest_point(t, w);
  CHECK(std::abs(yield_function(y)) < 1e-14);
  CHECK(y.n == Approx(1.0).epsilon(1e-12));
  const YieldPoint near = closest_point({t.n, 1e-9, t.m}, w); // continuous in v
  CHECK(y.m == Approx(near.m).margin(1e-7));
}

TEST_CASE("Trials a hundred times outside, and on the axes, return", "[unit][dem]")
{
  Trials trials;
  double worst = 0.0;
  for (int k = 0; k < 50000; ++k) {
    const YieldPoint y = closest_point(trials.outside(trials.decades(0.1, 2)),
                                       trials.weights(BendingFlow::conjugate));
    worst = std::max(worst, std::abs(yield_function(y)));
  }
  CHECK(worst < 1e-10);

  const EnergyNorm w{1.0, 2.0, 3.0};
  CHECK(closest_point({5.0, 0.0, 0.0}, w).n == Approx(1.0).epsilon(1e-15));
  CHECK(closest_point({-5.0, 0.0, 0.0}, w).n == Approx(-1.0).epsilon(1e-15));
  CHECK(closest_point({0.0, 7.0, 0.0}, w).v == Approx(1.0).epsilon(1e-15));
  CHECK(closest_point({0.0, 0.0, 9.0}, w).m == Approx(1.0).epsilon(1e-15));
}
