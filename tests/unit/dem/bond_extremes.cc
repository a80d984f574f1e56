#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <limits>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 30e-3, dt = 1e-4;

/// A bonded pair along x; both ends move.
Scene pair()
{
  Scene s;
  s.p.add(sphere({0, 0, 0}, R));
  s.p.add(sphere({2.0 * R, 0, 0}, R));
  s.bond({{0, 1}});
  return s;
}

/// Stretch [m] (mode 0), shear [m] (1: both particles rotate alike, so the normal stays) or
/// bend [rad] (2) the pair by `by`.
BondReading strain(Scene& s, int mode, double by)
{
  ParticleState &i = s.p.state[0], &j = s.p.state[1];
  const double turn = mode == 1 ? -by / (2.0 * R) : 0.0, bend = mode == 2 ? 0.5 * by : 0.0;
  j.v = {mode == 0 ? by / dt : 0.0, 0, 0};
  j.x += dt * j.v;
  i.omega = {0, 0, (turn - bend) / dt};
  j.omega = {0, 0, (turn + bend) / dt};
  s.forces(dt);
  return read_bond(s.bonds, 0, s.p, s.cell, s.material.bond);
}

bool is_finite(const BondReturn& r)
{
  const double numbers[] = {r.loads.N, r.loads.T,          r.state.u_p,
                            r.loss,    r.breakage_release, r.state.intact};
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](double x) { return std::isfinite(x); }) &&
         vec3(r.loads.V).allFinite() && vec3(r.loads.M).allFinite();
}

/// A trial `factor` times the strengths; at random one or two loads are zero.
EffectiveLoads<double> far_trial(std::mt19937_64& random, const DamageBond& b,
                                 const BondShape<double>& s, double factor)
{
  std::uniform_real_distribution<double> share(0.1, 1.0), unit(0.0, 1.0);
  const double sign = unit(random) < 0.5 ? -1.0 : 1.0;
  const BondStrength y = bond_strength(b, s, sign);
  double n = share(random), v = share(random), m = share(random);
  const double drop = unit(random);
  if (drop < 0.1)
    n = 0.0;
  else if (drop < 0.2)
    v = 0.0;
  else if (drop < 0.3)
    m = 0.0;
  else if (drop < 0.35)
    v = m = 0.0;
  else if (drop < 0.4)
    n = v = 0.0;
  else if (drop < 0.45)
    n = m = 0.0;
  return {sign * factor * n * y.N,
          triple(factor * v * y.V * random_vector(random).normalized()),
          triple(factor * m * y.M * random_vector(random).normalized())};
}

} // namespace

TEST_CASE(
    "In fifty reversals a bond acts as a slider of its strength, and each one damages",
    "[unit][dem]")
{
  // One load alone: q = k (u - u^p) within its strengths, D = 1 - exp(-sum |du^p|/u_c).
  DamageBond law = bond_of_table_1();
  law.u_c = 20e-3;
  law.theta_c = 1.0;
  const auto shape = bond_shape(law, R, 0.5 / R);
  const BondStrength pull = bond_strength(law, shape, 1.0);
  const double press = bond_strength(law, shape, -1.0).N;
  const double low[] = {-press, -pull.V, -pull.M}, high[] = {pull.N, pull.V, pull.M};
  const double k[] = {shape.k_n, shape.k_s, shape.k_b};
  const double scale[] = {law.u_c, law.u_c, law.theta_c};
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> past(0.1, 0.5), steps(1.0, 9.0);
  for (int mode = 0; mode < 3; ++mode) {
    Scene s = pair();
    s.bond_law() = law;
    double q = 0.0, plastic = 0.0;
    for (int reversal = 0; reversal < 50; ++reversal) {
      const double yields = (reversal % 2 ? low : high)[mode];
      const double all = (yields - q) / k[mode] + past(random) * yields / k[mode];
      const int n = static_cast<int>(steps(random));
      BondReading r{};
      for (int step = 0; step < n; ++step) {
        // in shear the lever arm is half the distance, as the pair does not stretch then
        r = strain(s, mode, all / n);
        const double trial = q + k[mode] * all / n;
        q = std::clamp(trial, low[mode], high[mode]);
        plastic += std::abs(trial - q) / k[mode];
      }
      const double intact = std::exp(-plastic / scale[mode]);
      const double load = mode == 0 ? r.N : mode == 1 ? r.V.y() : r.M.z();
      CAPTURE(mode, reversal, intact);
      // round-off of positions, 1e-17 m in 0.15 mm, over some hundred steps
      REQUIRE(1.0 - r.D == Approx(intact).epsilon(1e-10));
      REQUIRE(load == Approx(intact * q).epsilon(1e-10));
    }
    CHECK(plastic / scale[mode] > 0.1);
  }
}

TEST_CASE("A trial 1e2 to 1e12 strengths outside returns in one step, with finite numbers",
          "[unit][dem]")
{
  std::mt19937_64 random(12);
  DamageBond b = bond_of_table_1();
  b.flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  b.kappa = GENERATE(1e-6, 2.0, 1e12);
  b.u_c = b.theta_c = GENERATE(1e-30, 1e-4, 1e20);
  const auto shape = bond_shape(b, R, 0.5 / R);
  double worst = 0.0, smallest_loss = 0.0;
  bool finite = true, within = true;
  for (const double factor : {1e2, 1e4, 1e8, 1e12})
    for (int k = 0; k < 300; ++k) {
      const auto trial = far_trial(random, b, shape, factor);
      const BondReturn r = return_bond(b, shape, 1.0, {}, {}, trial);
      finite = finite && is_finite(r);
      within = within && r.state.intact >= 0.0 && r.state.intact <= 1.0;
      worst = std::max(worst, std::abs(yield_value(b, shape, r.loads)));
      smallest_loss = std::min(smallest_loss, r.loss);
    }
  CAPTURE(static_cast<int>(b.flow), b.kappa, b.u_c);
  CHECK(finite);
  CHECK(within);
  CHECK(worst < 1e-14); // measured 1.8e-15: on the surface for every trial
  CHECK(smallest_loss >= 0.0);
}

TEST_CASE("A pair that does not move keeps every bit of a bond within the yield surface",
          "[unit][dem]")
{
  Scene s = pair();
  s.p.state[1].x += Vec3(5e-5, 0, 0); // stretched once, at rest since
  s.forces(0.0);
  const BondBlock before = s.bonds.blocks[0];
  const Load f = s.p.load[0];
  for (int step = 0; step < 1000; ++step) s.forces(dt);
  const BondBlock& now = s.bonds.blocks[0];
  CHECK(f.f.x() > 0.0);
  CHECK(s.p.load[0].f == f.f);
  CHECK(s.p.load[0].t == f.t);
  CHECK(vec3(lane(now.V, 0)) == vec3(lane(before.V, 0)));
  CHECK(vec3(lane(now.M, 0)) == vec3(lane(before.M, 0)));
  CHECK(now.u_p[0] == before.u_p[0]);
  CHECK(now.intact[0] == 1.0);
}

TEST_CASE("A bond held on the yield surface for 1e4 steps neither creeps nor dissipates",
          "[unit][dem]")
{
  // There f differs from zero by round-off of either sign; the return then changes the last
  // bit of the loads.
  for (int seed = 1; seed <= 4; ++seed) {
    Scene s = pair();
    s.bond_law().u_c = 5e-3;
    s.bond_law().theta_c = 0.3;
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const Vec3 v = 1e-5 / dt * random_vector(random), w = 1e-3 / dt * random_vector(random);
    ParticleState &i = s.p.state[0], &j = s.p.state[1];
    for (int step = 0; step < 60; ++step) {
      j.v = v;
      j.x += dt * v;
      i.omega = -w;
      j.omega = w;
      s.forces(dt);
    }
    i.omega = j.omega = j.v = Vec3::Zero();
    s.forces(dt);
    const BondBlock before = s.bonds.blocks[0];
    const Load held = s.p.load[0];
    const double lost = s.losses.plastic.value();
    for (int step = 0; step < 10000; ++step) s.forces(dt);
    CAPTURE(seed, before.intact[0]);
    CHECK(before.intact[0] < 0.99);
    CHECK(before.intact[0] > 0.01);
    CHECK((s.p.load[0].f - held.f).norm() < 1e-14 * held.f.norm()); // measured 5e-16
    CHECK(s.bonds.blocks[0].intact[0] == Approx(before.intact[0]).epsilon(1e-14));
    CHECK(s.losses.plastic.value() - lost < 1e-14 * lost);
  }
}

TEST_CASE("An extremely soft or stiff bond gives finite loads and a finite history",
          "[unit][dem]")
{
  const double kappa = GENERATE(1e-6, 1e12), u_c = GENERATE(1e-15, 1e15);
  Scene s = pair();
  s.bond_law().kappa = kappa;
  s.bond_law().u_c = u_c;
  s.bond_law().theta_c = u_c;
  std::mt19937_64 random(2);
  bool finite = true;
  for (int step = 0; step < 300; ++step) {
    ParticleState &i = s.p.state[0], &j = s.p.state[1];
    j.v = 1e-4 / dt * random_vector(random);
    j.x += dt * j.v;
    i.omega = 1e-2 / dt * random_vector(random);
    j.omega = 1e-2 / dt * random_vector(random);
    s.forces(dt);
    const BondReading r = read_bond(s.bonds, 0, s.p, s.cell, s.material.bond);
    finite = finite && std::isfinite(r.N) && r.V.allFinite() && r.M.allFinite() &&
             std::isfinite(r.energy) && s.p.load[0].f.allFinite() &&
             s.p.load[1].t.allFinite();
  }
  CAPTURE(kappa, u_c, s.losses.broken, s.losses.yielded);
  CHECK(finite);
  CHECK(s.losses.yielded > 0);
  CHECK(s.losses.broken == (u_c < 1.0 ? 1 : 0)); // at once, or never
}

TEST_CASE("A motion that is not finite stops the run at an intact bond", "[unit][dem]")
{
  // A comparison with a NaN is false, so the bond is not elastic; the exact sum refuses its
  // loss.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity})
    for (const auto member : {&ParticleState::x, &ParticleState::v, &ParticleState::omega})
      for (int component = 0; component < 3; ++component)
        for (std::size_t end = 0; end < 2; ++end) {
          Scene s = pair();
          (s.p.state[end].*member)[component] = bad;
          CAPTURE(bad, component, end);
          CHECK_THROWS_AS(s.forces(dt), mergel::NumericalError);
        }
}

TEST_CASE("A motion that is not a number stops the step also after the bond broke",
          "[unit][dem]")
{
  // The force is then not a number; drift() or the rotation constraint throws.
  for (const auto member : {&ParticleState::x, &ParticleState::v, &ParticleState::omega}) {
    Scene s = pair();
    strain(s, 0, 10e-3); // 67 times the yield displacement
    REQUIRE(s.losses.broken == 1);
    (s.p.state[1].*member)[1] = std::nan("");
    CHECK_THROWS_AS(s.step(dt), mergel::NumericalError);
  }
}
