/// Combined loading of one bond against the rate form of Eqs. 2-7 of the paper.
#include "tests/support/catch.h"

#include "tests/verification/bond_rate_form.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

const Vec2 none(0, 0), ex(1, 0), ey(0, 1);

/// A straight stage of a path, in units of the motion that reaches each strength alone.
struct LoadingStage {
  double n;
  Vec2 v, m;
};

struct Path {
  const char* name;
  std::vector<LoadingStage> stages;
};

const Path paths[] = {
    {"tension, shear and bending", {{3, 2 * ex, 2 * ey}}},
    {"compression, shear and bending", {{-3, 2 * ex, 2 * ey}}},
    {"mostly bending", {{1, 0.5 * ex, 3 * ey}}},
    {"mostly shear", {{0.5, 3 * ex, 0.5 * ey}}},
    {"shear and bending", {{0, 3 * ex, 2 * ey}}},
    {"a little compression", {{-0.6, 2 * ex, 2.5 * ey}}},
    {"edge m = 0 in tension", {{2, 2 * ex, none}}},
    {"edge m = 0 in compression", {{-2, 2 * ex, none}}},
    {"down to the edge", {{3, 3 * ex, 0.3 * ey}}},
    {"along the edge and off it", {{1.2, 1.2 * ex, none}, {0, 0.1 * ex, 3 * ey}}},
    {"to the tip n = 1", {{3, none, 0.5 * ey}}},
    {"past the tip", {{1, none, 2 * ey}}},
    {"rotating directions",
     {{1, 0.5 * ex, 0.2 * ey}, {0.2, 1 * ey, 1 * ex}, {-1.2, 0.3 * ex, 0.5 * ey}}},
};

/// States along the path, with n steps between two checks.
template <class Integrator>
std::vector<BondPoint> follow(const Path& path, const OneBond& bond, int n)
{
  std::vector<BondPoint> out;
  Integrator at(bond);
  for (const LoadingStage& stage : path.stages)
    follow_stage(at, bond.motion(stage.n, stage.v, stage.m), n, out);
  return out;
}

/// Largest true loads over strengths.
struct Peak {
  double n = 0.0, v = 0.0, m = 0.0;

  void see(const BondPoint& at)
  {
    n = std::max(n, std::abs(at.n));
    v = std::max(v, at.v.norm());
    m = std::max(m, at.m.norm());
  }
};

/// Largest relative difference; a load of zero does not count.
double difference(const Peak& a, const Peak& b)
{
  const auto of = [](double x, double y) { return y > 0.0 ? std::abs(x / y - 1.0) : 0.0; };
  return std::max({of(a.n, b.n), of(a.v, b.v), of(a.m, b.m)});
}

/// Share of the stage at which the bond first yields.
double elastic_range(const OneBond& bond, const LoadingStage& stage)
{
  const auto is_outside = [&](double share) {
    LawPath at(bond);
    at.step(share * bond.motion(stage.n, stage.v, stage.m));
    return at.s() > 0.0;
  };
  double low = 0.0, high = 2.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (is_outside(middle) ? high : low) = middle;
  }
  return low;
}

/// Peak over three elastic ranges in steps of range/n, each divided into `parts`; the first
/// step is `first` times the others, so that yield lies within a step.
template <class Integrator>
Peak peak(const OneBond& bond, const LoadingStage& stage, double range, int n, double first,
          int parts)
{
  Integrator at(bond);
  Peak out;
  for (int step = 0; step < 3 * n; ++step) {
    const double share = range / n * (step == 0 ? first : 1.0);
    const BondMotion du = (share / parts) * bond.motion(stage.n, stage.v, stage.m);
    for (int part = 0; part < parts; ++part) at.step(du);
    out.see(at.at());
  }
  return out;
}

} // namespace

TEST_CASE("Combined loading converges to the rate form at first order in the step",
          "[verification][dem]")
{
  // u_c and theta_c such that damage grows over the whole path. The coarsest run has some
  // 40 to 150 steps in the elastic range.
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  for (const Path& path : paths) {
    const OneBond bond(flow, 0.5e-3, 20e-3);
    const auto exact = follow<RateForm>(path, bond, 8000);
    const double reference_error = worst(follow<RateForm>(path, bond, 4000), exact);
    double e[4]; // in loads over strengths, and in D
    for (int k = 0; k < 4; ++k) e[k] = worst(follow<LawPath>(path, bond, 8 << k), exact);
    CAPTURE(path.name, static_cast<int>(flow), reference_error, e[0], e[1], e[2], e[3]);
    REQUIRE(exact.back().D > 0.5);
    CHECK(reference_error < 0.02 * e[3]);
    // Measured 3e-5 (tip) to 1.1e-2 (mostly bending), both with the published flow.
    CHECK(e[0] < 0.012);
    // Backward Euler: halving the step halves the error; measured 1.85 to 2.06.
    for (int k = 0; k < 3; ++k) CHECK(e[k] / e[k + 1] == Approx(2.0).epsilon(0.12));
  }
}

TEST_CASE("Five steps in the elastic range give the peak load within half a percent",
          "[verification][dem]")
{
  // The peak is at yield, a kink of the curve: a run that steps over it finds 1 - x/n of
  // it, x the share of a step, with any law. The error of the law is the difference from
  // the rate form at the same instants: one step of a method of first order. Softening of
  // Table 1 (theta_c = 0.1 mrad) and of Table 3 (10 mrad).
  const LoadingStage stages[] = {{1, 0.5 * ex, 0.4 * ey}, {-1, 0.5 * ex, 0.4 * ey},
                                 {0.5, 1 * ex, 0.2 * ey}, {0.3, 0.3 * ex, 1 * ey},
                                 {1, 1 * ex, none},       {1, none, 0.3 * ey},
                                 {-0.3, 1 * ex, 1 * ey}};
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  const double theta_c = GENERATE(0.1e-3, 10e-3);
  // measured: 3.9e-3, 9.1e-4, 2.2e-4, 1.1e-5
  const std::pair<int, double> allowed[] = {
      {5, 5e-3}, {10, 1.2e-3}, {20, 3e-4}, {100, 3e-5}};
  for (const auto& [n, most] : allowed) {
    double own = 0.0, on_yield = 0.0;
    for (const LoadingStage& stage : stages) {
      const OneBond bond(flow, 0.1e-3, theta_c);
      const double range = elastic_range(bond, stage);
      const Peak exact = peak<RateForm>(bond, stage, range, 5000, 1.0, 1);
      on_yield = std::max(on_yield,
                          difference(peak<LawPath>(bond, stage, range, n, 1.0, 1), exact));
      for (const double first : {0.25, 0.5, 0.75})
        own = std::max(own, difference(peak<LawPath>(bond, stage, range, n, first, 1),
                                       peak<RateForm>(bond, stage, range, n, first, 1000)));
    }
    CAPTURE(static_cast<int>(flow), theta_c, n, own, on_yield);
    CHECK(own < most);
    CHECK(on_yield < 1e-9); // exact where a step ends at yield
  }
}

TEST_CASE("Straight loading settles where the plastic flow is parallel to the motion",
          "[verification][dem]")
{
  // Perfect plasticity in effective loads: dq = 0 where k du = Lambda k dg/dq (Eqs. 2, 7).
  const auto flow = GENERATE(BendingFlow::conjugate, BendingFlow::published);
  const OneBond bond(flow, 1e20, 1e20); // no damage: u_c beyond any motion
  const double R_b = bond.shape.R_b;
  const double M_0 = bond.strength(1.0).M, V_0 = bond.strength(1.0).V;
  for (const double sign : {1.0, -1.0}) {
    const double N_0 = bond.strength(sign).N;
    for (const double n : {0.2, 0.5, 0.8})
      for (const double h : {0.1, 0.4, 0.9}) { // v^2 = h (1-n^2), m = (1-n^2)(1-h^2)
        const double p = 1.0 - n * n, v = std::sqrt(h * p);
        const double length = flow == BendingFlow::conjugate ? 1.0 : R_b;
        const BondMotion along{sign * 2.0 * n * (1.0 + h * h) / N_0, 4.0 * v * h / V_0 * ex,
                               length / M_0 * ey};
        LawPath at(bond);
        const double step = 100.0 * N_0 * N_0 / bond.shape.k_n;
        for (int k = 0; k < 50; ++k) at.step(step * along);
        const BondPoint q = at.at();
        CAPTURE(static_cast<int>(flow), sign, n, h, q.n, q.v.x(), q.m.y());
        CHECK(std::abs(q.n) == Approx(n).epsilon(1e-9));
        CHECK(q.v.norm() == Approx(v).epsilon(1e-9));
        CHECK(q.m.norm() == Approx(p * (1.0 - h * h)).epsilon(1e-9));
      }
  }
}
