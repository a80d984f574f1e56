#include "dem/pairs/strength.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/error.h"
#include "dem/walls/mirror.h"
#include "dem/walls/triangulated.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace mergel::dem;
using namespace mergel::dem::test;
using Distribution = StrengthVariability::Distribution;

namespace {

constexpr double R = 1e-3;

Particles particles(std::size_t n)
{
  Particles p;
  for (std::size_t k = 0; k < n; ++k)
    p.add(sphere({0.0, 0.0, 2.0 * R * static_cast<double>(k)}, R));
  return p;
}

/// Share below f in a distribution of mean 1 and this coefficient of variation.
double share_below(const StrengthVariability& v, double f)
{
  if (v.distribution == Distribution::log_normal) {
    const double s2 = std::log(1.0 + v.variation * v.variation);
    return 0.5 * std::erfc(-(std::log(f) + 0.5 * s2) / std::sqrt(2.0 * s2));
  }
  const double k = weibull_shape(v.variation);
  return 1.0 - std::exp(-std::pow(f * std::tgamma(1.0 + 1.0 / k), k));
}

/// Kolmogorov's distance of the drawn factors from their distribution.
double distance(const StrengthVariability& v, std::vector<double> drawn)
{
  std::sort(drawn.begin(), drawn.end());
  const auto n = static_cast<double>(drawn.size());
  double most = 0.0;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const double share = share_below(v, drawn[k]);
    most = std::max(
        {most, share - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - share});
  }
  return most;
}

/// Two bonded particles with these strength factors, moved apart by u [m] in a step of 1 s.
struct Pulled {
  Scene s;

  Pulled(const BondLaw& law, std::vector<double> strength, const Vec3& u)
  {
    s.p = particles(2);
    s.material.bond = law;
    s.p.strength = std::move(strength);
    s.bond({{0, 1}});
    s.forces(1.0);
    s.move_pair({Vec3::Zero(), u}, {Vec3::Zero(), Vec3::Zero()}, 1.0);
  }
  /// Load along this direction over 1 - D [N]: on the yield surface once the bond yields.
  double effective(const Vec3& along) const
  {
    const BondReading r = read_bond(s.bonds, 0, s.p, s.cell, s.material.bond);
    return (r.N * Vec3::UnitZ() + r.V).dot(along) / (1.0 - r.D);
  }
};

} // namespace

TEST_CASE("Strength factors follow their distribution with mean 1 and the given variation",
          "[unit][dem]")
{
  constexpr std::size_t n = 20000;
  for (const Distribution law : {Distribution::log_normal, Distribution::weibull})
    for (const double c : {0.1, 0.3, 0.6}) {
      const StrengthVariability v{law, c, 5};
      Particles p = particles(n);
      draw_strengths(v, p);
      const StrengthSpread s = describe_strengths(p);
      // Four standard errors: of the mean, c/sqrt(n) each; of the standard deviation,
      // sqrt((kurtosis - 1)/(4 n)) of it each, kurtosis at most 12 (log-normal, c = 0.6).
      // Measured 0.003 and 0.01 at most.
      CHECK(s.mean == Approx(1.0).margin(4.0 * c / std::sqrt(n)));
      CHECK(s.variation == Approx(c).epsilon(4.0 * std::sqrt(11.0 / (4.0 * n))));
      // Kolmogorov's bound at the level of 1 %.
      CHECK(distance(v, p.strength) < 1.63 / std::sqrt(n));
    }
}

TEST_CASE("Weibull's shape is 1 for the exponential, 2 for Rayleigh's distribution",
          "[unit][dem]")
{
  CHECK(weibull_shape(1.0) == Approx(1.0).epsilon(1e-12));
  CHECK(weibull_shape(std::sqrt(4.0 / pi - 1.0)) == Approx(2.0).epsilon(1e-12));
  // For small variation k = pi/(sqrt(6) c), Gumbel's limit; the next term is of order c.
  CHECK(weibull_shape(1e-4) == Approx(pi / std::sqrt(6.0) * 1e4).epsilon(1e-3));
}

TEST_CASE("A strength factor depends only on the id of its particle and the seed",
          "[unit][dem]")
{
  for (const Distribution law : {Distribution::log_normal, Distribution::weibull}) {
    const StrengthVariability v{law, 0.3, 2};
    Particles many = particles(50), some = particles(3), again = particles(50);
    some.id = {4, 17, 41};
    draw_strengths(v, many);
    draw_strengths(v, some);
    draw_strengths({law, 0.3, 3}, again);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(some.strength[k] == many.strength[some.id[k]]);
    CHECK(again.strength[7] != many.strength[7]);
  }
  Particles none = particles(4);
  draw_strengths({}, none);
  CHECK(none.strength.empty());
}

TEST_CASE("A bond yields at its strengths times the mean factor of its particles",
          "[unit][dem]")
{
  const DamageBond law = bond_of_table_1();
  const double A = pi * R * R / 9.0, f = 0.5 * (0.4 + 1.1);
  const std::vector<double> factors{0.4, 1.1};
  const Vec3 z = Vec3::UnitZ(), x = Vec3::UnitX();
  // The elastic load would be 1.5 times the strength of the law, 2 times that of the bond.
  const double unit = 1.5 * 2.0 * R / law.E;
  // Round-off of the gap, 1e-16 R, over the motion of 1e-5 R.
  CHECK(Pulled(law, factors, unit * law.sigma_t * z).effective(z) ==
        Approx(f * law.sigma_t * A).epsilon(1e-10));
  CHECK(Pulled(law, factors, -unit * law.sigma_c * z).effective(z) ==
        Approx(-f * law.sigma_c * A).epsilon(1e-10));
  // The shear rotates the bond by 1e-2, half of which the motion counts, and stretches it.
  CHECK(std::abs(Pulled(law, factors, unit * law.kappa * law.C * x).effective(x)) ==
        Approx(f * law.C * A).epsilon(2e-2));
  // Below: elastic, in tension at 0.7 of the law's strength with f = 0.75.
  const double low = 0.7 * 2.0 * R / law.E * law.sigma_t;
  CHECK(Pulled(law, factors, low * z).s.losses.yielded == 0);
  CHECK(Pulled(law, {0.4, 0.9}, low * z).s.losses.yielded == 1);
  CHECK(Pulled(law, {}, low * z).s.losses.yielded == 0);

  ParallelBond brittle;
  static_cast<BondSection&>(brittle) = law;
  brittle.sigma_c = law.sigma_t;
  brittle.tau_c = law.C;
  CHECK(Pulled(brittle, factors, low * z).s.losses.broken == 0);
  CHECK(Pulled(brittle, {0.4, 0.9}, low * z).s.losses.broken == 1);
}

TEST_CASE("Each bond of a batch takes the factors of its own particles", "[unit][dem]")
{
  const std::size_t n = n_lanes + 3; // a batch and a part of one
  Scene s;
  s.p = particles(n + 1);
  std::vector<Pair> pairs;
  for (Index k = 0; k < n; ++k) pairs.push_back({k, k + 1});
  for (std::size_t k = 0; k <= n; ++k)
    s.p.strength.push_back(0.5 + 0.1 * static_cast<double>(k));
  s.bond(pairs);
  const double u = 3.0 * 2.0 * R / 400e6 * 1e6;
  for (std::size_t k = 0; k <= n; ++k) s.p.state[k].x.z() += u * static_cast<double>(k);
  s.forces(1.0);
  for (std::size_t b = 0; b < n; ++b) {
    const BondReading r = read_bond(s.bonds, b, s.p, s.cell, s.material.bond);
    const double f = 0.55 + 0.1 * static_cast<double>(b);
    CHECK(r.N / (1.0 - r.D) == Approx(f * 1e6 * pi * R * R / 9.0).epsilon(1e-9));
  }
}

TEST_CASE("Factors of 1 give the same bits as no factors", "[unit][dem]")
{
  std::mt19937_64 random(1);
  Scene a;
  a.p = particles(30);
  std::vector<Pair> pairs;
  for (Index k = 0; k + 1 < 30; ++k) pairs.push_back({k, k + 1});
  a.bond(pairs);
  for (ParticleState& b : a.p.state) b.v = 3.0 * random_vector(random);
  Scene b = a;
  b.p.strength.assign(30, 1.0);
  for (int step = 0; step < 50; ++step) {
    a.step(1e-7);
    b.step(1e-7);
  }
  CHECK(a.losses.yielded > 100);
  CHECK(a.losses.yielded == b.losses.yielded);
  CHECK(a.losses.plastic.value() == b.losses.plastic.value());
  for (std::size_t k = 0; k < 30; ++k) {
    CHECK(a.p.state[k].x == b.p.state[k].x);
    CHECK(a.p.load[k].t == b.p.load[k].t);
  }
}

TEST_CASE("Bonds to a wall and to the mirror image take the factor of their particle",
          "[unit][dem]")
{
  const DamageBond law = bond_of_table_1();
  const double A = pi * R * R / 9.0, f = 0.6;
  Particles p;
  p.add(sphere({2.0 * R, R, R}, R));
  p.strength = {f};
  PairLosses losses;
  const double dt = 1.0;

  Mirror mirror;
  bond_to_mirror(mirror, p, 0.01 * R);
  const double u = 0.7 * R / law.E * law.sigma_t; // the image doubles it, over two radii
  p.state[0].v.y() = u / dt;
  p.state[0].x.y() += u;
  add_wall_forces(mirror, {law, no_contact()}, dt, p, losses);
  CHECK(-p.load[0].f.y() / mirror.pairs[0].bond.intact ==
        Approx(f * law.sigma_t * A).epsilon(1e-9));

  clear_loads(p);
  Wall wall = make_wall({{0, 0, 0}, {4.0 * R, 0, 0}, {4.0 * R, 4.0 * R, 0}}, {{0, 1, 2}},
                        no_contact());
  bond_to_wall(wall, p, 0.01 * R);
  REQUIRE(wall.bonds.size() == 1);
  for (std::size_t k = 0; k < wall.x.size(); ++k) {
    wall.v[k] = Vec3(0.0, 0.0, -u / dt);
    wall.x[k].z() -= u;
  }
  p.state[0].v.setZero();
  wall.bonds_yield = true;
  add_wall_forces(wall, {law, {}}, dt, p, losses);
  CHECK(-p.load[0].f.z() / wall.bonds[0].state.intact ==
        Approx(f * law.sigma_t * A).epsilon(1e-9));
}

TEST_CASE("A coefficient of variation out of range is refused", "[unit][dem]")
{
  Particles p = particles(2);
  for (const double c : {0.0, -0.1, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(draw_strengths({Distribution::weibull, c, 1}, p), mergel::InputError);
    CHECK_NOTHROW(draw_strengths({Distribution::none, c, 1}, p));
  }
}
