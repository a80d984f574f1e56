#include "dem/laws/bond.h"

namespace mergel::dem {

namespace {

/// (n, v) of the conditions of the minimum at given mu and h, with their slopes.
struct Section {
  double n, v;       ///< n as a magnitude
  double n_h, v_h;   ///< slopes in h
  double n_mu, v_mu; ///< slopes in mu
};

Section section(const YieldPoint& trial, const EnergyNorm& w, double mu, double h)
{
  const double a = 1.0 + 2.0 * mu * (1.0 + h * h) / w.n;
  const double b = 1.0 + 4.0 * mu * h / w.v;
  Section s;
  s.n = trial.n / a;
  s.v = trial.v / b;
  s.n_h = -s.n * (4.0 * mu * h / w.n) / a;
  s.v_h = -s.v * (4.0 * mu / w.v) / b;
  s.n_mu = -s.n * (2.0 * (1.0 + h * h) / w.n) / a;
  s.v_mu = -s.v * (4.0 * h / w.v) / b;
  return s;
}

/// Root in [0, 1] of h (1 - n^2) - v^2, which rises with h where n < 1; 1 when the section
/// lies beyond the ellipse even there.
double solve_h(const YieldPoint& trial, const EnergyNorm& w, double mu, double h)
{
  const auto residual = [](const Section& s, double h_) {
    return h_ * (1.0 - s.n * s.n) - s.v * s.v;
  };
  if (residual(section(trial, w, mu, 1.0), 1.0) <= 0.0) return 1.0;
  if (trial.v == 0.0) { // on the axis, where h is free at the tip n = 1 and 0 inside of it
    const double beyond = (trial.n - 1.0) * w.n - 2.0 * mu;
    return beyond > 0.0 ? std::sqrt(beyond / (2.0 * mu)) : 0.0; // mu > 0 since h < 1
  }
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const Section s = section(trial, w, mu, h);
    const double g = residual(s, h);
    (g > 0.0 ? high : low) = h;
    const double slope = 1.0 - s.n * s.n - 2.0 * h * s.n * s.n_h - 2.0 * s.v * s.v_h;
    double next = slope > 0.0 ? h - g / slope : 2.0;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - h) <= 4e-16 * h || high - low <= 4e-16 * high) return next;
    h = next;
  }
  return h;
}

/// Closest point of the ellipse n^2 + v^2 = 1 to a trial outside of it, and its multiplier.
double return_to_ellipse(YieldPoint& y, const EnergyNorm& w)
{
  const YieldPoint trial = y;
  double mu = 0.0;
  // 1/rho is nearly linear in mu and concave: Newton from mu = 0 rises to the root.
  for (int i = 0; i < 60; ++i) {
    const Section s = section(trial, w, mu, 1.0);
    const double rho2 = s.n * s.n + s.v * s.v, rho = std::sqrt(rho2);
    y = {s.n / rho, s.v / rho, 0.0};
    const double step = rho2 / -(s.n * s.n_mu + s.v * s.v_mu) * (rho - 1.0);
    mu += step;
    if (std::abs(rho - 1.0) <= 4e-16 || std::abs(step) <= 1e-16 * mu) break;
  }
  return mu;
}

} // namespace

YieldPoint closest_point(const YieldPoint& given, const EnergyNorm& w)
{
  YieldPoint trial = given;
  trial.n = std::abs(given.n);
  const auto with_sign = [&](YieldPoint y) {
    y.n = std::copysign(y.n, given.n);
    return y;
  };

  if (trial.n * trial.n + trial.v * trial.v > 1.0) {
    YieldPoint y = trial;
    const double mu = return_to_ellipse(y, w);
    if (mu >= w.m * trial.m) return with_sign(y); // m* - mu/w.m <= 0: the edge
  }

  // f(0) > 0, f(w.m m*) <= 0 because m is spent there and the edge was excluded. f(mu) can
  // be S-shaped near the tip n = 1, where Newton may cycle between two ends of the bracket.
  double low = 0.0, high = w.m * trial.m, mu = 0.0, h = 1.0;
  double width_before = 2.0 * high;
  Section s{};
  for (int i = 0; i < 200; ++i) {
    h = solve_h(trial, w, mu, std::clamp(h, 1e-3, 1.0));
    s = section(trial, w, mu, h);
    const bool beyond = h >= 1.0;
    const double m = trial.m - mu / w.m;
    const double f = beyond ? m + 2.0 * (s.n * s.n + s.v * s.v) - 2.0
                            : m + s.n * s.n + s.v * s.v * h - 1.0;
    (f > 0.0 ? low : high) = mu;
    double dn = s.n_mu, dv = s.v_mu;
    if (!beyond) {
      const double g_h = 1.0 - s.n * s.n - 2.0 * h * s.n * s.n_h - 2.0 * s.v * s.v_h;
      const double g_mu = -2.0 * h * s.n * s.n_mu - 2.0 * s.v * s.v_mu;
      dn -= s.n_h * g_mu / g_h;
      dv -= s.v_h * g_mu / g_h;
    }
    const double slope = -1.0 / w.m + 2.0 * s.n * (1.0 + h * h) * dn + 4.0 * s.v * h * dv;
    double next = mu - f / slope; // slope <= -1/w.m
    const bool is_slow = i % 3 == 2 && high - low > 0.5 * width_before;
    if (is_slow || !(next > low && next < high)) next = 0.5 * (low + high);
    if (i % 3 == 2) width_before = high - low;
    const bool done = std::abs(f) <= 2e-15 || std::abs(next - mu) <= 4e-16 * mu ||
                      high - low <= 4e-16 * high;
    mu = next;
    if (done) break;
  }
  // The surface in its own parameters: exact whatever is left of f.
  const double p = std::max(0.0, 1.0 - s.n * s.n);
  return with_sign({s.n, std::min(trial.v, std::sqrt(h * p)), p * (1.0 - h * h)});
}

double yield_value(const DamageBond& b, const BondShape<double>& s,
                   const EffectiveLoads<double>& q)
{
  const BondStrength strength = bond_strength(b, s, q.N);
  return yield_function({q.N / strength.N, std::sqrt(dot(q.V, q.V)) / strength.V,
                         std::sqrt(dot(q.M, q.M)) / strength.M});
}

BondReturn return_bond(const DamageBond& b, const BondShape<double>& s, double S,
                       const BondState& state, const EffectiveLoads<double>& old,
                       const EffectiveLoads<double>& trial)
{
  const BondStrength strength = bond_strength(b, s, trial.N);
  const double V = std::sqrt(dot(trial.V, trial.V)), M = std::sqrt(dot(trial.M, trial.M));
  const YieldPoint y{trial.N / strength.N, V / strength.V, M / strength.M};

  BondReturn r;
  r.state = state;
  r.loads = trial;
  if (yield_function(y) > 0.0) {
    // published: the length that Eq. 7 leaves out is 1 m in SI
    const double k_flow = b.flow == BendingFlow::conjugate ? s.k_b : s.k_b * s.R_b;
    const YieldPoint at =
        closest_point(y, {strength.N * strength.N / s.k_n, strength.V * strength.V / s.k_s,
                          strength.M * strength.M / k_flow});
    r.loads.N = at.n * strength.N;
    r.loads.V = trial.V * (y.v > 0.0 ? at.v / y.v : 1.0);
    r.loads.M = trial.M * (y.m > 0.0 ? at.m / y.m : 1.0);
  }

  const double du_n = (trial.N - r.loads.N) / s.k_n;
  const double du_s = std::max(0.0, V - std::sqrt(dot(r.loads.V, r.loads.V))) / s.k_s;
  const double dtheta = std::max(0.0, M - std::sqrt(dot(r.loads.M, r.loads.M))) / s.k_b;
  r.state.u_p += du_n;
  r.state.intact *= std::exp(-((std::abs(du_n) + du_s) / (b.u_c * S) + dtheta / b.theta_c));

  // Work of the true loads over the motion (trial - old)/k, trapezoidal.
  const double d0 = state.intact, d1 = r.state.intact;
  const auto work_of = [&](const EffectiveLoads<double>& q) {
    return mutual_energy(s, q, trial) - mutual_energy(s, q, old);
  };
  const double at_end = 0.5 * d1 * work_of(r.loads);
  const double stored = d1 * spring_energy(s, r.loads);
  r.loss = 0.5 * d0 * work_of(old) + at_end - (stored - d0 * spring_energy(s, old));
  if (r.state.intact <= 1.0 - b.D_broken) {
    r.state.intact = 0.0;
    r.residue = stored - at_end;
  }
  return r;
}

} // namespace mergel::dem
