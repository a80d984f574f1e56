#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("The yield function and its slope are continuous across n^2 + v^2 = 1",
          "[unit][dem]")
{
  // One-sided differences along n and along v: a kink would show as a jump of the slope.
  const double h = 1e-7;
  for (int k = 1; k < 60; ++k) {
    const double phi = k * pi / 120.0;
    const double n = std::cos(phi), v = std::sin(phi);
    const auto f = [](double n_, double v_) { return yield_function({n_, v_, 0.3}); };
    INFO("n = " << n << ", v = " << v);
    CHECK(f(n, v) == Approx(0.3).margin(1e-12));
    const double inside_n = (f(n, v) - f(n - h, v)) / h,
                 outside_n = (f(n + h, v) - f(n, v)) / h;
    const double inside_v = (f(n, v) - f(n, v - h)) / h,
                 outside_v = (f(n, v + h) - f(n, v)) / h;
    // The second derivative of v^4/(1-n^2) reaches 8/v^2 there: h times it, plus round-off.
    const double bend = 20.0 * h / (v * v) + 1e-8;
    CHECK(std::abs(outside_n - inside_n) < bend);
    CHECK(std::abs(outside_v - inside_v) < bend);
    CHECK(outside_n == Approx(4.0 * n).margin(bend));
  }
}

TEST_CASE("The continued yield function is convex", "[unit][dem]")
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(0.0, 1.5);
  double worst = 0.0;
  for (int trial = 0; trial < 200000; ++trial) {
    const YieldPoint a{u(random) * 2.0 - 1.5, u(random), u(random)};
    const YieldPoint b{u(random) * 2.0 - 1.5, u(random), u(random)};
    const YieldPoint middle{0.5 * (a.n + b.n), 0.5 * (a.v + b.v), 0.5 * (a.m + b.m)};
    worst = std::max(worst, yield_function(middle) -
                                0.5 * (yield_function(a) + yield_function(b)));
  }
  CHECK(worst < 1e-14); // round-off of numbers below 10
}

TEST_CASE("The exponent 1.001 of Eq. 5 changes f by at most 3.7e-4", "[unit][dem]")
{
  double largest = 0.0;
  for (int k = 1; k <= 10000; ++k) {
    const double m = k * 1e-4;
    CHECK(std::pow(m, 1.001) <= m);
    largest = std::max(largest, m - std::pow(m, 1.001));
  }
  // The maximum is at m = 1/e: 1e-3/e to first order.
  CHECK(largest == Approx(1e-3 / std::exp(1.0)).epsilon(1e-3));
  CHECK(largest < 3.7e-4);
}

TEST_CASE("is_elastic(), without division or root, agrees with the yield function",
          "[unit][dem]")
{
  const DamageBond b = bond_of_table_1();
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(-1.3, 1.3), size(1e-5, 3e-2);
  int n_inside = 0, n_outside = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double R = size(random);
    const auto shape = bond_shape(b, R, 0.5 / R);
    const double n = u(random);
    const BondStrength strength = bond_strength(b, shape, n);
    const Vec3 v = 0.8 * random_vector(random), m = 0.6 * random_vector(random);
    const EffectiveLoads<double> q{n * strength.N, triple(strength.V * v),
                                   triple(strength.M * m)};
    const double f = yield_function({n, v.norm(), m.norm()});
    if (std::abs(f) < 1e-12) continue; // within round-off of the surface
    REQUIRE(static_cast<bool>(is_elastic(b, shape, q)) == (f < 0.0));
    (f < 0.0 ? n_inside : n_outside) += 1;
  }
  CHECK(n_inside > 10000);
  CHECK(n_outside > 10000);
}

TEST_CASE("An unloaded bond is elastic, and bond parameters out of range are refused",
          "[unit][dem]")
{
  const DamageBond good = bond_of_table_1();
  CHECK_NOTHROW(good.check());
  CHECK(is_elastic(good, bond_shape(good, 1e-4, 5e3), EffectiveLoads<double>{}));

  const auto refused = [&](auto&& change) {
    DamageBond b = good;
    change(b);
    CHECK_THROWS_AS(b.check(), mergel::InputError);
  };
  refused([](DamageBond& b) { b.E = 0.0; });
  refused([](DamageBond& b) { b.kappa = -1.0; });
  refused([](DamageBond& b) { b.sigma_t = 0.0; });
  refused([](DamageBond& b) { b.sigma_c = std::nan(""); });
  refused([](DamageBond& b) { b.C = 0.0; });
  refused([](DamageBond& b) { b.u_c = 0.0; });
  refused([](DamageBond& b) { b.theta_c = -1e-3; });
  refused([](DamageBond& b) { b.lambda_b = 1.01; });
  refused([](DamageBond& b) { b.lambda_b = 0.0; });
  refused([](DamageBond& b) { b.D_broken = 1.0; });
  refused([](DamageBond& b) { b.D_broken = 0.0; });
}
