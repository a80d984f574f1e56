#include "dem/laws/bond.h"

namespace mergel::dem {

namespace {

/// (n, v) from the conditions of the minimum at given mu and h, with their slopes.
struct Section {
  double n, v;       ///< both >= 0
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

/// Root in [0, 1] of h (1 - n^2) - v^2, which rises with h where n < 1. Returns 1 when the
/// point is outside the ellipse even at h = 1.
double solve_h(const YieldPoint& trial, const EnergyNorm& w, double mu, double h)
{
  const auto residual = [](const Section& s, double h_) {
    return h_ * (1.0 - s.n * s.n) - s.v * s.v;
  };
  if (residual(section(trial, w, mu, 1.0), 1.0) <= 0.0) return 1.0;
  if (trial.v == 0.0) { // on the axis: h is free at the tip n = 1, and 0 below it
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

/// (n, v) at h = 1, for the return to the edge m = 0. The slope of rho2 = n^2 + v^2 in mu
/// is -2 fall.
struct EdgeSection {
  double n, v, rho2, fall;
};

EdgeSection edge_section(const YieldPoint& trial, const EnergyNorm& w, double mu)
{
  const double c_n = 4.0 / w.n, c_v = 4.0 / w.v;
  const double inv_a = 1.0 / (1.0 + c_n * mu), inv_b = 1.0 / (1.0 + c_v * mu);
  const double n = trial.n * inv_a, v = trial.v * inv_b;
  return {n, v, n * n + v * v, c_n * n * n * inv_a + c_v * v * v * inv_b};
}

/// Closest point of the ellipse n^2 + v^2 = 1 to a trial outside of it.
YieldPoint return_to_ellipse(const YieldPoint& trial, const EnergyNorm& w)
{
  YieldPoint y{};
  double mu = 0.0;
  // 1/rho is concave and nearly linear in mu: Newton from mu = 0 rises to the root.
  for (int i = 0; i < 60; ++i) {
    const EdgeSection s = edge_section(trial, w, mu);
    const double rho = std::sqrt(s.rho2), inv_rho = 1.0 / rho;
    y = {s.n * inv_rho, s.v * inv_rho, 0.0};
    const double step = s.rho2 * (rho - 1.0) / s.fall;
    mu += step;
    if (std::abs(rho - 1.0) <= 1e-15 || std::abs(step) <= 1e-16 * mu) break;
  }
  return y;
}

/// The fast path of closest_point(): Newton for mu and h together, from the trial itself.
/// Returns false, with y unchanged, where it leaves the admissible set or does not
/// converge.
///
/// With N = n^2, V = v^2 and subscripts for slopes it solves
///
///   f = m + N + h V - 1 = 0,   g = h (1 - N) - V = 0
bool return_by_newton(YieldPoint& y, const EnergyNorm& w)
{
  const YieldPoint trial = y;
  const double c_n = 2.0 / w.n, c_v = 4.0 / w.v, c_m = 1.0 / w.m;
  const double N_trial = trial.n * trial.n, V_trial = trial.v * trial.v;
  const double round_off = 1e-15 * (1.0 + trial.m);
  double mu = 0.0, h = V_trial < 1.0 - N_trial ? V_trial / (1.0 - N_trial) : 1.0;
  for (int i = 0; i < 8; ++i) {
    const double inv_a = 1.0 / (1.0 + c_n * mu * (1.0 + h * h));
    const double inv_b = 1.0 / (1.0 + c_v * mu * h);
    const double n = trial.n * inv_a, v = trial.v * inv_b;
    const double N = n * n, V = v * v, m = trial.m - mu * c_m;
    const double f = m + N + h * V - 1.0, g = h * (1.0 - N) - V;
    if (std::abs(f) <= round_off && std::abs(g) <= 1e-15 * h) {
      // m from the surface, so that the residual of f does not matter; >= 0 since h <= 1
      y = {n, v, std::max(0.0, 1.0 - N - h * V)};
      return true;
    }
    const double N_mu = -2.0 * N * c_n * (1.0 + h * h) * inv_a;
    const double N_h = -4.0 * N * c_n * mu * h * inv_a;
    const double V_mu = -2.0 * V * c_v * h * inv_b, V_h = -2.0 * V * c_v * mu * inv_b;
    const double f_mu = N_mu + h * V_mu - c_m, f_h = N_h + V + h * V_h;
    const double g_mu = -h * N_mu - V_mu, g_h = 1.0 - N - h * N_h - V_h;
    const double inv_det = 1.0 / (f_mu * g_h - f_h * g_mu);
    mu -= (f * g_h - g * f_h) * inv_det;
    h -= (g * f_mu - f * g_mu) * inv_det;
    if (!(mu >= 0.0 && h >= 0.0 && h <= 1.0)) return false;
  }
  return false;
}

/// 1/k of each load; 0 for the twisting moment of a bond without twist, where T is 0.
struct Compliance {
  double n, s, b, t;
};

Compliance compliance(const BondShape<double>& s)
{
  return {1.0 / s.k_n, 1.0 / s.k_s, 1.0 / s.k_b, s.k_t > 0.0 ? 1.0 / s.k_t : 0.0};
}

/// mutual_energy() of bond_section.h, with the compliances given.
double mutual_energy(const Compliance& c, const EffectiveLoads<double>& q0,
                     const EffectiveLoads<double>& q1)
{
  return q0.N * q1.N * c.n + dot(q0.V, q1.V) * c.s + dot(q0.M, q1.M) * c.b +
         q0.T * q1.T * c.t;
}

} // namespace

// Two paths. In a run the trial is just outside the surface, where Newton for mu and h
// together converges in two or three steps. The problem is convex: a point of the
// admissible set that satisfies all conditions is the closest point, so no other check is
// needed. Near the tip n = 1 and from trials far outside that Newton may not converge. Then
// the search within a bracket follows, which is slower and always converges.
YieldPoint closest_point(const YieldPoint& given, const EnergyNorm& w)
{
  YieldPoint trial = given;
  trial.n = std::abs(given.n);
  const auto with_sign = [&](YieldPoint y) {
    y.n = std::copysign(y.n, given.n);
    return y;
  };

  if (trial.n * trial.n + trial.v * trial.v > 1.0) {
    // the edge, where m = m* - mu/w.m falls to 0 while the point is outside the ellipse
    const bool is_edge = edge_section(trial, w, w.m * trial.m).rho2 >= 1.0;
    if (is_edge) return with_sign(return_to_ellipse(trial, w));
  }

  YieldPoint y = trial;
  if (return_by_newton(y, w)) return with_sign(y);

  // f(0) > 0, and f(w.m m*) <= 0 because m is 0 there and the edge was excluded. f(mu) can
  // be S-shaped near the tip n = 1, where Newton may cycle between the ends of the bracket.
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
  // From the parameters of the surface: the point is on it whatever the residual of f.
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

BreakMode break_mode(const DamageBond& b, const BondShape<double>& s,
                     const EffectiveLoads<double>& q)
{
  const BondStrength strength = bond_strength(b, s, q.N);
  const double n = q.N / strength.N, n2 = n * n;
  const double v2 = dot(q.V, q.V) / (strength.V * strength.V);
  const double m = std::sqrt(dot(q.M, q.M)) / strength.M;
  const double shear = n2 + v2 < 1.0 ? v2 * v2 / (1.0 - n2) : v2; // 1 - n2 > v2 >= 0
  if (m >= n2 && m >= shear) return BreakMode::bending;
  if (shear >= n2) return BreakMode::shear;
  return q.N > 0.0 ? BreakMode::tension : BreakMode::compression;
}

BondReturn return_bond(const DamageBond& b, const BondShape<double>& s, double S,
                       const BondState& state, const EffectiveLoads<double>& old,
                       const EffectiveLoads<double>& trial)
{
  const BondStrength strength = bond_strength(b, s, trial.N);
  const Compliance c = compliance(s);
  const double V = std::sqrt(dot(trial.V, trial.V)), M = std::sqrt(dot(trial.M, trial.M));
  const YieldPoint y{trial.N / strength.N, V / strength.V, M / strength.M};

  BondReturn r;
  r.state = state;
  r.loads = trial;
  double keep_V = 1.0, keep_M = 1.0;
  if (yield_function(y) > 0.0) {
    // published: the length that Eq. 7 lacks is 1 m in SI units
    const double c_flow = b.flow == BendingFlow::conjugate ? c.b : c.b / s.R_b;
    const YieldPoint at =
        closest_point(y, {strength.N * strength.N * c.n, strength.V * strength.V * c.s,
                          strength.M * strength.M * c_flow});
    if (y.v > 0.0) keep_V = at.v / y.v;
    if (y.m > 0.0) keep_M = at.m / y.m;
    r.loads.N = at.n * strength.N;
    r.loads.V = trial.V * keep_V;
    r.loads.M = trial.M * keep_M;
  }

  const double du_n = (trial.N - r.loads.N) * c.n;
  const double du_s = std::max(0.0, V * (1.0 - keep_V)) * c.s;
  const double dtheta = std::max(0.0, M * (1.0 - keep_M)) * c.b;
  r.state.u_p += du_n;
  r.state.intact *= std::exp(-((std::abs(du_n) + du_s) / (b.u_c * S) + dtheta / b.theta_c));

  // Work of the true loads over the motion (trial - old)/k, by the trapezoidal rule.
  const double d0 = state.intact, d1 = r.state.intact;
  const EffectiveLoads<double> step{trial.N - old.N, trial.V - old.V, trial.M - old.M,
                                    trial.T - old.T};
  const double at_end = 0.5 * d1 * mutual_energy(c, r.loads, step);
  const double stored = 0.5 * d1 * mutual_energy(c, r.loads, r.loads);
  const double from_start =
      0.5 * d0 * (mutual_energy(c, old, step) + mutual_energy(c, old, old));
  r.loss = from_start + at_end - stored;
  if (r.state.intact <= 1.0 - b.D_broken) {
    r.state.intact = 0.0;
    r.breakage_release = stored - at_end;
  }
  return r;
}

} // namespace mergel::dem
