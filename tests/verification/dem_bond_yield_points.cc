#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

struct Outcome {
  double worst_f = 0.0, smallest_loss = 0.0;
  int at_edge = 0, n = 0;
};

/// Proportional loading of a virgin bond from zero to `factor` times the surface in one
/// step.
Outcome load_to(double factor, BendingFlow flow)
{
  DamageBond b = bond_of_table_1();
  b.flow = flow;
  b.u_c = 1.0; // negligible damage
  b.theta_c = 1.0;
  const auto shape = bond_shape(b, 0.03, 1.0 / 0.06);
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Outcome out;
  for (int k = 0; k < 4000; ++k) {
    const double sign = u(random) < 0.5 ? -1.0 : 1.0;
    const BondStrength strength = bond_strength(b, shape, sign);
    // a point on m = 1 - n^2 - v^4/(1-n^2), then outwards
    const double n = u(random), v = u(random) * std::sqrt(1.0 - n * n);
    const double m = 1.0 - n * n - std::pow(v, 4) / (1.0 - n * n);
    const Vec3 e_v = random_vector(random).normalized(),
               e_m = random_vector(random).normalized();
    const EffectiveLoads<double> trial{factor * sign * n * strength.N,
                                       triple(factor * v * strength.V * e_v),
                                       triple(factor * m * strength.M * e_m)};
    const BondReturn r = return_bond(b, shape, 1.0, {}, {}, trial);
    const double f =
        yield_function({r.loads.N / strength.N, vec3(r.loads.V).norm() / strength.V,
                        vec3(r.loads.M).norm() / strength.M});
    out.worst_f = std::max(out.worst_f, std::abs(f));
    out.smallest_loss = std::min(out.smallest_loss, r.loss);
    out.at_edge += vec3(r.loads.M).norm() < 1e-12 * strength.M;
    ++out.n;
    // radial in V and in M
    REQUIRE(vec3(r.loads.V).dot(e_v) >= 0.0);
    REQUIRE(vec3(r.loads.V).cross(e_v).norm() <= 1e-9 * strength.V);
    REQUIRE(vec3(r.loads.M).cross(e_m).norm() <= 1e-9 * strength.M);
  }
  return out;
}

} // namespace

TEST_CASE("Trials 1 to 100 times outside return to v^4 = (1-m-n^2)(1-n^2) and dissipate",
          "[verification][dem]")
{
  // Surface: Eq. 5 of the paper with m to the power 1; n^2 > 1 is among the trials.
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  int at_edge = 0;
  for (const double factor : {1.001, 1.1, 2.0, 10.0, 100.0}) {
    const Outcome out = load_to(factor, flow);
    CAPTURE(factor, out.at_edge, out.n);
    CHECK(out.worst_f < 1e-10);
    CHECK(out.smallest_loss >= 0.0);
    at_edge += out.at_edge;
  }
  if (flow == BendingFlow::conjugate) CHECK(at_edge > 1000); // often to the edge m = 0
}
