/// The law against the algorithm that the paper prints: Appendix 1, Eqs. 9-11, with Eqs. 3
/// and 7. Misprints are corrected (Eq. 3 accumulates; rows 2 and 3 of Eq. 11 use their own
/// displacement). Eq. 10 is tested as printed and corrected, and Appendix 2 in both of its
/// readings.
#include "tests/support/catch.h"

#include "tests/verification/bond_rate_form.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Plastic multiplier of Eq. 10.
enum class Multiplier {
  mended,    ///< with df/dD of the strengths, which cancels df/dD of the loads
  as_printed ///< the strengths are constant while the loads decrease with D
};

/// The two readings of Appendix 2.
enum class ClosestPoint {
  gradient_only, ///< the gradients of Eqs. 7, 10 are those of this point; f need not vanish
  receives_the_load ///< the load of Eq. 11 is also moved to it
};

struct Reading {
  Multiplier multiplier = Multiplier::mended;
  ClosestPoint closest = ClosestPoint::gradient_only;
  double exponent = 1.0; ///< of m in Eq. 5; 1.001 as printed
};

/// One bond in true loads N, V and Mbar = M/R_b, loaded along fixed directions.
class Published {
public:
  Published(const OneBond& bond, const Reading& how) : b_(bond), how_(how) {}

  void step(const BondMotion& du)
  {
    const auto& s = b_.shape;
    const double d = std::exp(-s_);
    const double k_n = d * s.k_n, k_s = d * s.k_s, k_b = d * s.k_b / s.R_b;
    q_.N += k_n * du.u_n; // Eq. 9
    q_.V += k_s * du.u_s.norm();
    q_.M += k_b * du.theta.norm();
    const Loads strength = strengths(d);
    const YieldPoint trial = over(q_, strength);
    const double f = yield(trial);
    if (f <= 0.0) return;

    const Loads g = gradient(closest(trial, strength), strength);
    const double gkg = g.N * k_n * g.N + g.V * k_s * g.V + g.M * k_b * g.M;
    const double lambda = f / (gkg + bracket(g, d)); // Eq. 10
    const double du_n = lambda * g.N;                // Eq. 7
    // no further than to zero: on the edge m = 0 the flow would reverse the moment
    const double du_s = std::min(lambda * g.V, q_.V / k_s);
    const double dtheta = std::min(lambda * g.M, q_.M / k_b);
    s_ += (std::abs(du_n) + du_s) / b_.law.u_c + dtheta / b_.law.theta_c; // Eq. 3
    const double shrink = std::exp(-s_) / d;                              // Eq. 11
    q_ = {shrink * (q_.N - k_n * du_n), shrink * (q_.V - k_s * du_s),
          shrink * (q_.M - k_b * dtheta)};
    if (how_.closest == ClosestPoint::receives_the_load) put_on_surface();
  }

  BondPoint at() const
  {
    const Loads y = strengths(1.0);
    return {q_.N / y.N, Vec2(q_.V / y.V, 0.0), Vec2(0.0, q_.M / y.M), 1.0 - std::exp(-s_)};
  }

private:
  /// N, V, Mbar: loads, strengths (Eq. 6) or a gradient.
  struct Loads {
    double N = 0.0, V = 0.0, M = 0.0;
  };

  Loads strengths(double d) const
  {
    const BondStrength y = b_.strength(q_.N);
    return {d * y.N, d * y.V, d * y.M / b_.shape.R_b};
  }
  static YieldPoint over(const Loads& q, const Loads& strength)
  {
    return {q.N / strength.N, q.V / strength.V, q.M / strength.M};
  }
  /// Eq. 5; beyond n = 1, where it would change sign, the continuation of the law.
  double yield(const YieldPoint& y) const
  {
    const double n2 = y.n * y.n, v2 = y.v * y.v, m = std::pow(y.m, how_.exponent);
    if (v2 == 0.0) return m + n2 - 1.0;
    return n2 < 1.0 ? m + n2 + v2 * v2 / (1.0 - n2) - 1.0 : m + 2.0 * (n2 + v2) - 2.0;
  }
  /// Eq. 12, distances in newtons.
  static YieldPoint closest(const YieldPoint& y, const Loads& strength)
  {
    return closest_point(
        y, {strength.N * strength.N, strength.V * strength.V, strength.M * strength.M});
  }
  /// df/d(N, V, Mbar); zero in M where no moment ever acts, as with m^0.001.
  Loads gradient(const YieldPoint& y, const Loads& strength) const
  {
    const double p = 1.0 - y.n * y.n;
    const double h = y.v > 0.0 ? std::min(1.0, y.v * y.v / std::max(p, 1e-300)) : 0.0;
    return {2.0 * y.n * (1.0 + h * h) / strength.N, 4.0 * y.v * h / strength.V,
            q_.M > 0.0 ? how_.exponent * std::pow(y.m, how_.exponent - 1.0) / strength.M
                       : 0.0};
  }
  /// -(df/dD) (dD/du^p . g), in which df/dD of the loads, -X/(1-D) each, and of the
  /// strengths cancel: f depends on their ratio.
  double bracket(const Loads& g, double d) const
  {
    if (how_.multiplier == Multiplier::mended) return 0.0;
    const double dD = d * ((std::abs(g.N) + g.V) / b_.law.u_c + g.M / b_.law.theta_c);
    return (g.N * q_.N + g.V * q_.V + g.M * q_.M) / d * dD;
  }
  void put_on_surface()
  {
    const Loads strength = strengths(std::exp(-s_));
    const YieldPoint y = over(q_, strength);
    if (yield(y) <= 0.0) return;
    const YieldPoint at = closest(y, strength);
    q_ = {at.n * strength.N, at.v * strength.V, at.m * strength.M};
  }

  const OneBond& b_;
  Reading how_;
  Loads q_;
  double s_ = 0.0;
};

/// A straight path, in units of the motion that reaches each strength alone.
struct Path {
  const char* name;
  double n, v, m;
};

const Path single[] = {{"tension", 3, 0, 0},
                       {"compression", -3, 0, 0},
                       {"shear", 0, 3, 0},
                       {"bending", 0, 0, 3}};
const Path combined[] = {
    {"tension, shear and bending", 3, 2, 2}, {"compression, shear and bending", -3, 2, 2},
    {"mostly bending", 1, 0.5, 3},           {"mostly shear", 0.5, 3, 0.5},
    {"shear and bending", 0, 3, 2},          {"tension and bending", 2, 0, 2},
    {"tension and shear", 2, 2, 0}};

/// States at 20 times along the path, with n steps between two.
template <class Integrator>
std::vector<BondPoint> follow(const Path& path, const OneBond& bond, Integrator at, int n)
{
  std::vector<BondPoint> out;
  follow_stage(at, bond.motion(path.n, Vec2(path.v, 0.0), Vec2(0.0, path.m)), n, out);
  return out;
}

const Reading mended{}, printed{Multiplier::as_printed, ClosestPoint::gradient_only},
    printed_on_surface{Multiplier::as_printed, ClosestPoint::receives_the_load};

} // namespace

TEST_CASE("Under one load the published algorithm follows the law at second order",
          "[verification][dem]")
{
  // The law is exact here, N = exp(-(u-u_y)/u_c). One Taylor step of f = n^2 - 1 or v^4 - 1
  // leaves an error of the square of its length, one of f = m - 1 none.
  const OneBond bond(BendingFlow::published, 0.5e-3, 20e-3);
  for (const Path& path : single) {
    CAPTURE(path.name);
    const auto law = follow(path, bond, LawPath(bond), 16);
    const auto error = [&](int n) {
      return worst(follow(path, bond, Published(bond, mended), n), law);
    };
    const double e_1 = error(16), e_2 = error(32);
    CAPTURE(e_1, e_2);
    CHECK(worst(follow(path, bond, LawPath(bond), 64), law) < 1e-10);
    if (path.m > 0.0)
      CHECK(e_1 < 1e-10);
    else {
      CHECK(e_1 < 4e-4); // measured 5.6e-5 to 2.3e-4
      CHECK(e_1 / e_2 == Approx(4.0).epsilon(0.05));
    }
  }
}

TEST_CASE(
    "Under combined loads the published algorithm, Eq. 10 corrected, has the law's limit",
    "[verification][dem]")
{
  const OneBond bond(BendingFlow::published, 0.5e-3, 20e-3);
  for (const Path& path : combined) {
    const auto exact = follow(path, bond, RateForm(bond), 8000);
    double e[3], apart[3];
    for (int k = 0; k < 3; ++k) {
      const int n = 32 << (2 * k);
      const auto ours = follow(path, bond, LawPath(bond), n);
      const auto theirs = follow(path, bond, Published(bond, mended), n);
      e[k] = worst(theirs, exact);
      apart[k] = worst(theirs, ours);
    }
    CAPTURE(path.name, e[0], e[1], e[2], apart[0], apart[1], apart[2]);
    CHECK(e[0] < 6e-3);           // measured 3.8e-4 to 4.5e-3
    for (int k = 0; k < 2; ++k) { // first order: 1/4 of the step, 1/4 of the error
      CHECK(e[k] / e[k + 1] == Approx(4.0).epsilon(0.15));
      CHECK(apart[k] / apart[k + 1] == Approx(4.0).epsilon(0.15));
    }
  }
}

TEST_CASE("Eq. 10 as printed has the same limit with a larger error", "[verification][dem]")
{
  // Its multiplier is too small by the factor 1 + u_y/u_c (under one load): f settles at a
  // value of the order of the step instead of its square. Measured: 12 (tension and
  // bending) to 870 times (tension and shear) the error of Eq. 10 corrected, at the same
  // step.
  double smallest = 1e300, most = 0.0;
  for (const Path& path : combined) {
    const OneBond bond(BendingFlow::published, 0.1e-3, 10e-3); // Tables 1 and 3
    const auto exact = follow(path, bond, RateForm(bond), 8000);
    const auto error = [&](const Reading& how, int n) {
      return worst(follow(path, bond, Published(bond, how), n), exact);
    };
    const double e_1 = error(printed, 256), e_2 = error(printed, 1024);
    const double ratio = e_1 / error(mended, 256);
    CAPTURE(path.name, e_1, e_2, ratio);
    CHECK(e_1 / e_2 == Approx(4.0).epsilon(0.15));
    CHECK(ratio > 5.0);
    smallest = std::min(smallest, ratio);
    most = std::max(most, ratio);
  }
  CAPTURE(smallest, most);
  CHECK(smallest < 20.0);
  CHECK(most > 100.0);
}

TEST_CASE("Eq. 10 as printed, its load moved to the surface, softens over u_c + u_y",
          "[verification][dem]")
{
  // Each step then adds 1/(1 + u_y/u_c) of the plastic motion and removes the rest of f
  // without counting it: N = exp(-(u-u_y)/(u_c+u_y)) in place of Eq. 3. Appendix 2 can only
  // have the other reading.
  const OneBond bond(BendingFlow::published, 0.5e-3, 20e-3);
  for (const Path& path : single) {
    const BondMotion at = bond.motion(path.n / 3.0, {path.v / 3.0, 0}, {path.m / 3.0, 0});
    const double u_y = path.m > 0.0 ? at.theta.norm() : std::abs(at.u_n) + at.u_s.norm();
    const double scale = path.m > 0.0 ? bond.law.theta_c : bond.law.u_c;
    const auto error = [&](int n) {
      const BondPoint end =
          follow(path, bond, Published(bond, printed_on_surface), n).back();
      const double load = std::abs(end.n) + end.v.norm() + end.m.norm();
      return std::abs(load / std::exp(-2.0 * u_y / (scale + u_y)) - 1.0);
    };
    const double e_1 = error(64), e_2 = error(256);
    CAPTURE(path.name, e_1, e_2);
    CHECK(e_1 < 4e-3); // measured 2.9e-4 to 2.3e-3
    CHECK(e_1 / e_2 == Approx(4.0).epsilon(0.05));
  }
}

TEST_CASE("The exponent 1.001 of Eq. 5 moves the limit by less than 1e-3",
          "[verification][dem]")
{
  double most = 0.0;
  for (const double theta_c : {0.1e-3, 10e-3})
    for (const Path& path : combined) {
      const OneBond bond(BendingFlow::published, 0.1e-3, theta_c);
      Reading sharp = mended, rounded = mended;
      rounded.exponent = 1.001;
      most = std::max(most, worst(follow(path, bond, Published(bond, rounded), 1024),
                                  follow(path, bond, Published(bond, sharp), 1024)));
    }
  CAPTURE(most);
  CHECK(most < 1e-3); // measured 7.5e-4
  CHECK(most > 1e-4);
}
