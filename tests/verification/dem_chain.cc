#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 0.03, d = 2.0 * R;

/// A free row of 2 n + 1 bonded particles along x, the middle one at 0.
Scene row(int n)
{
  Scene s;
  s.material.bond = unbreakable_bond();
  std::vector<Pair> pairs;
  for (int k = -n; k <= n; ++k) {
    const Index i = s.p.add(sphere({d * k, 0, 0}, R));
    if (i > 0) pairs.push_back({i - 1, i});
  }
  s.bond(pairs);
  return s;
}

/// E A of the row as a bar [N]: the load on its end per strain.
double bar_stiffness()
{
  Scene s = row(5);
  const double strain = 1e-7;
  for (ParticleState& b : s.p.state) b.x *= 1.0 + strain;
  s.forces(0.0);
  return s.p.load[0].f.x() / strain;
}

/// Bar velocity sqrt(E A/(m/d)) [m/s].
double bar_velocity()
{
  return std::sqrt(bar_stiffness() * d / row(0).p.state[0].m);
}

/// Speed [m/s] of a pulse released at rest with displacements exp(-(x/width)^2/2): motion
/// of the centre of its right half, weighted by u^2, between 100 and 200 diameters. A step
/// is `courant` d/c.
double pulse_speed(double width, double courant)
{
  Scene s = row(280);
  const double c = bar_velocity(), dt = courant * d / c;
  std::vector<double> x_0;
  for (ParticleState& b : s.p.state) {
    x_0.push_back(b.x.x());
    b.x.x() += 1e-4 * d * std::exp(-0.5 * std::pow(b.x.x() / width, 2));
  }
  const auto centre = [&] {
    double moment = 0.0, weight = 0.0;
    for (std::size_t i = s.p.size() / 2; i < s.p.size(); ++i) {
      const double u2 = std::pow(s.p.state[i].x.x() - x_0[i], 2);
      moment += u2 * x_0[i];
      weight += u2;
    }
    return moment / weight;
  };
  s.start(dt);
  int step = 1;
  const auto travel = [&](double distance) {
    for (; step * dt * c < distance; ++step) s.step(dt);
    return std::pair{centre(), step * dt};
  };
  const auto [x_1, t_1] = travel(100.0 * d);
  const auto [x_2, t_2] = travel(200.0 * d);
  return (x_2 - x_1) / (t_2 - t_1);
}

} // namespace

TEST_CASE("A chain of bonded particles oscillates at omega = 2 sqrt(k/m) sin(kappa d/2)",
          "[verification][dem]")
{
  // Born and von Karman (1912): standing wave of wave number kappa = 2 pi j/(n d) on a
  // periodic chain.
  const int n = 24;
  for (const int j : {1, 4, 8, 12}) {
    Scene s;
    s.material.bond = unbreakable_bond();
    s.cell.size = {n * d, 0.0, 0.0};
    std::vector<Pair> pairs;
    const double kappa = 2.0 * pi * j / (n * d);
    for (Index i = 0; i < n; ++i) {
      s.p.add(sphere({d * i, 0, 0}, R));
      s.p.state[i].v.x() = 1e-3 * std::cos(kappa * d * i);
      if (i + 1 < n) pairs.push_back({i, i + 1});
    }
    pairs.insert(pairs.begin() + 1, {0, n - 1, {-1, 0, 0}});
    s.bond(pairs);
    const double k = 400e6 * pi * R * R / 9.0 / d, m = s.p.state[0].m;
    const double omega = 2.0 * std::sqrt(k / m) * std::sin(0.5 * kappa * d);
    const double dt = 0.02 / omega;
    s.start(dt);
    double before = 1.0, first = 0.0, last = 0.0;
    int zeros = 0;
    for (int step = 1; zeros <= 8; ++step) {
      s.step(dt);
      double v = 0.0; // amplitude of the mode at t = step dt + dt/2
      for (Index i = 0; i < n; ++i) v += s.p.state[i].v.x() * std::cos(kappa * d * i);
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
    CHECK(s.p.state[3].v.y() == 0.0);
    CHECK(s.p.state[3].omega.norm() == 0.0);
  }
}

TEST_CASE(
    "A pulse travels along a chain of bonded particles at d sqrt(k/m) = sqrt(E/rho), and "
    "more slowly the shorter it is",
    "[verification][dem]")
{
  const auto bond = unbreakable_bond();
  const double R_b = bond.lambda_b * R, EA = bond.E * pi * R_b * R_b;
  CHECK(bar_stiffness() == Approx(EA).epsilon(2e-7)); // a strain of 1e-7; measured 4e-9
  const double c = bar_velocity();
  // Born and von Karman (1912): omega = 2 sqrt(k/m) sin(kappa d/2) has the group velocity
  // c cos(kappa d/2). Weighted by the spectrum exp(-(kappa width)^2) of u^2, whose mean
  // kappa^2 is 1/(2 width^2), the pulse lags by d^2/(16 width^2). The leapfrog compensates
  // (c dt/d)^2 of that; at c dt = d it has no dispersion.
  const double courant = 0.2;
  const auto lag = [&](double width) { return 1.0 - pulse_speed(width * d, courant) / c; };
  const double lag_4 = lag(4.0), lag_8 = lag(8.0), lag_16 = lag(16.0);
  CAPTURE(lag_4, lag_8, lag_16); // measured 3.7453e-3, 9.3721e-4, 2.3436e-4
  const double expected = (1.0 - courant * courant) / 16.0;
  // The next order is a fourth as large for twice the width: 1.3e-3, 3.1e-4 and 7e-5 of the
  // lag.
  CHECK(16.0 * lag_4 == Approx(expected).epsilon(1.5e-3));
  CHECK(64.0 * lag_8 == Approx(expected).epsilon(4e-4));
  CHECK(256.0 * lag_16 == Approx(expected).epsilon(1e-4));
}
