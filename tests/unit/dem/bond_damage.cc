#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

struct Walk {
  double smallest_loss = 0.0, total_loss = 0.0;
  bool healed = false;
  int n_yielded = 0, n_broken = 0;
};

/// Random walks in (u_n, u_s, theta), each step at most `stride` times the motion at yield.
Walk walk(BendingFlow flow, double stride)
{
  DamageBond b = bond_of_table_1();
  b.flow = flow;
  // Softening over about the elastic range, so that damage takes many steps.
  b.u_c = 1e-3;
  b.theta_c = 1e-1;
  const auto shape = bond_shape(b, 0.03, 1.0 / 0.06);
  const BondStrength strength = bond_strength(b, shape, 1.0);
  std::mt19937_64 random(5);
  Walk w;
  for (int path = 0; path < 200; ++path) {
    BondState state;
    EffectiveLoads<double> q{};
    Vec3 drift = random_vector(random);
    for (int step = 0; step < 2000 && state.intact > 0.0; ++step) {
      if (step % 100 == 0) drift = random_vector(random);
      const Vec3 du = stride * (0.5 * drift + random_vector(random));
      EffectiveLoads<double> trial = q;
      trial.N += du.x() * strength.N;
      trial.V += triple(stride * strength.V * random_vector(random));
      trial.M += triple(stride * strength.M * (0.3 * drift + random_vector(random)));
      if (is_elastic(b, shape, trial)) {
        q = trial;
        continue;
      }
      const BondReturn r = return_bond(b, shape, 1.0, state, q, trial);
      w.smallest_loss = std::min(w.smallest_loss, r.loss);
      w.total_loss += r.loss;
      w.healed = w.healed || r.state.intact > state.intact;
      ++w.n_yielded;
      w.n_broken += r.state.intact == 0.0;
      state = r.state;
      q = r.loads;
    }
  }
  return w;
}

} // namespace

TEST_CASE("Damage never decreases and the loss of a step is never negative", "[unit][dem]")
{
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  const double stride = GENERATE(0.01, 0.1);
  const Walk w = walk(flow, stride);
  CAPTURE(static_cast<int>(flow), stride, w.n_yielded, w.n_broken, w.total_loss);
  CHECK(w.n_yielded > 1000);
  CHECK_FALSE(w.healed);
  CHECK(w.smallest_loss > -1e-15 * w.total_loss);
}

TEST_CASE("A reversal of the plastic motion damages the bond further", "[unit][dem]")
{
  // Eq. 3 as printed, with |u_n^p| instead of its accumulation, would heal this bond.
  const DamageBond b = bond_of_table_1();
  const auto shape = bond_shape(b, 0.03, 1.0 / 0.06);
  const BondStrength tension = bond_strength(b, shape, 1.0),
                     press = bond_strength(b, shape, -1.0);
  const double step = 0.05e-3; // half of u_c
  const BondReturn out = return_bond(b, shape, 1.0, {}, {tension.N, {}, {}},
                                     {tension.N + shape.k_n * step, {}, {}});
  const BondReturn back = return_bond(b, shape, 1.0, out.state, {-press.N, {}, {}},
                                      {-press.N - shape.k_n * step, {}, {}});
  CHECK(out.state.u_p == Approx(step).epsilon(1e-12));
  CHECK(back.state.u_p == Approx(0.0).margin(1e-12 * step));
  CHECK(out.state.intact == Approx(std::exp(-0.5)).epsilon(1e-12));
  CHECK(back.state.intact == Approx(std::exp(-1.0)).epsilon(1e-12));
}

TEST_CASE("A bond breaks for good at the damage at breakage", "[unit][dem]")
{
  DamageBond b = bond_of_table_1();
  b.D_broken = 0.5;
  const auto shape = bond_shape(b, 0.03, 1.0 / 0.06);
  const double N = bond_strength(b, shape, 1.0).N;
  const auto pulled = [&](double plastic) {
    return return_bond(b, shape, 1.0, {}, {N, {}, {}}, {N + shape.k_n * plastic, {}, {}});
  };
  CHECK(pulled(b.u_c * std::log(2.0) * 0.999).state.intact > 0.5);
  const BondReturn gone = pulled(b.u_c * std::log(2.0) * 1.001);
  CHECK(gone.state.intact == 0.0);
  // Released: the energy stored in the damaged spring, less the work that its load at the
  // end of the step could not do.
  const double plastic = b.u_c * std::log(2.0) * 1.001;
  const double intact = std::exp(-std::log(2.0) * 1.001);
  CHECK(gone.breakage_release ==
        Approx(0.5 * intact * (N * N / shape.k_n - N * plastic)).epsilon(1e-12));
  // In total: half of the work of the step by its first load, and the energy stored then.
  CHECK(gone.loss + gone.breakage_release ==
        Approx(0.5 * N * plastic + 0.5 * N * N / shape.k_n).epsilon(1e-12));
}
