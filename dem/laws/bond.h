/// Damage-plasticity bond of the paper, section 2.1, with its misprints set right.
///
/// Loads (Eq. 2) and strengths (Eq. 6) both carry the factor 1 - D. In effective loads, the
/// loads divided by 1 - D, the yield surface does not move, and the law is perfect
/// plasticity followed by an update of the damage (dem/laws/README.md):
///
///   trial     N* = k_n0 A (u_n - u_n^p),  V* += k_s0 A du_s,  M* += k_b0 dtheta    (Eq. 2)
///   surface   f = m + n^2 + v^4/(1 - n^2) - 1,                                     (Eq. 5)
///             n = N*/(sigma_0 A), v = |V*|/(C A), m = |M*|/(sigma_t I/R_b),
///             sigma_0 = sigma_t in tension, sigma_c in compression
///   return    closest point of f <= 0 in the energy norm: associated flow          (Eq. 7)
///   damage    D = 1 - exp(-s), s += (|du_n^p| + |du_s^p|)/u_c + |dtheta^p|/theta_c (Eq. 3)
///   loads     (N, V, M) = (1 - D) (N*, V*, M*)
///
/// Departures from the paper, with reasons (dem/laws/README.md, Misprints of the paper):
/// - Eq. 5 has m^1.001. The exponent only rounds the edge m = 0 so that a Newton method has
///   a gradient there; f differs by at most 3.7e-4. Here the edge is treated as an edge,
///   with m to the power 1.
/// - Beyond n^2 + v^2 = 1 the printed f changes sign, so states of failure would be
///   elastic. There f continues with value and slope as m + 2 (n^2 + v^2) - 2; that f is
///   convex.
/// - Eq. 3 has |u_n^p|, with which damage would decrease when the load reverses. Here s
///   accumulates.
/// - Eqs. 10-14 (one Taylor step, Newton with four unknowns) are replaced by the exact
///   closest point, a backward Euler step.
/// - Eq. 12 measures distance in newtons; associated flow (Eq. 7) needs the energy norm.
/// - Eq. 7 for the moment: see BendingFlow.
#pragma once

#include "dem/laws/bond_section.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

/// The load to which the plastic rotation is conjugate: M, or M/R_b as printed.
///
/// conjugate: dtheta^p = Lambda dg/dM, the flow associated with Eq. 5 in the energy norm.
/// published: dtheta^p = Lambda dg/d(M/R_b) as printed in Eq. 7, which lacks a length. In
/// SI units the moment then relaxes 1/R_b times (some 1e4 times) more slowly than N and V.
enum class BendingFlow { conjugate, published };

/// The paper's bond.
struct DamageBond : BondSection {
  static constexpr const char* name = "damage"; ///< name in case files and summaries

  double sigma_t = 0.0; ///< tensile strength [Pa], > 0, Eq. 6
  double sigma_c = 0.0; ///< compressive strength [Pa], > 0
  double C = 0.0;       ///< shear strength [Pa], > 0
  double u_c = 0.0;     ///< softening displacement at S = 1 [m], > 0; scales with S, Eq. 8
  double theta_c = 0.0; ///< softening rotation [rad], > 0
  double D_broken = 0.99; ///< damage at breakage [-], in (0, 1)
  BendingFlow flow = BendingFlow::conjugate;

  /// @throws InputError when out of range
  void check() const
  {
    BondSection::check();
    require(sigma_t > 0.0 && sigma_c > 0.0 && C > 0.0, "bond strengths must be positive");
    require(u_c > 0.0 && theta_c > 0.0, "bond softening scales must be positive");
    require(D_broken > 0.0 && D_broken < 1.0, "damage at breakage must lie in (0, 1)");
  }
};

/// This law with all strengths times a factor; stiffness and softening are unchanged.
inline DamageBond with_strengths_times(double factor, DamageBond b)
{
  b.sigma_t *= factor;
  b.sigma_c *= factor;
  b.C *= factor;
  return b;
}

/// True where the trial is inside the surface: m + n^2 < 1 and v^4 < (1-m-n^2)(1-n^2),
/// rewritten without root or division:
///
///   p = 1 - n^2 > 0,   p^2 > v^4,   m^2 p^2 < (p^2 - v^4)^2
///
/// with both sides multiplied by the powers of A and R_b that remove the denominators.
template <class Real>
[[gnu::always_inline]] inline auto is_elastic(const DamageBond& b, const BondShape<Real>& s,
                                              const EffectiveLoads<Real>& q)
{
  const Real inv_sigma =
      select(q.N > Real{}, Real{} + 1.0 / b.sigma_t, Real{} + 1.0 / b.sigma_c);
  const Real n = q.N * inv_sigma;                                   // n A
  const Real v2 = dot(q.V, q.V) * (1.0 / (b.C * b.C));              // v^2 A^2
  const Real m2 = dot(q.M, q.M) * (16.0 / (b.sigma_t * b.sigma_t)); // m^2 A^2 R_b^2
  const Real A2 = s.A * s.A;
  const Real p = A2 - n * n;
  const Real rest = p * p - v2 * v2;
  return (p > Real{}) & (rest > Real{}) & (m2 * p * p * A2 < rest * rest * s.R_b * s.R_b);
}

/// Loads over their strengths: n keeps its sign, v and m are magnitudes.
struct YieldPoint {
  double n, v, m;
};

/// Continued yield function [-], negative inside; see the head of this file.
inline double yield_function(const YieldPoint& y)
{
  const double n2 = y.n * y.n, v2 = y.v * y.v;
  if (n2 + v2 < 1.0) return y.m + n2 + v2 * v2 / (1.0 - n2) - 1.0; // 1 - n2 > v2 >= 0
  return y.m + 2.0 * (n2 + v2) - 2.0;
}

/// Weights of the energy norm (n-n*)^2 w.n + (v-v*)^2 w.v + (m-m*)^2 w.m [J], all > 0.
struct EnergyNorm {
  double n, v, m;
};

/// The point of f <= 0 that is closest to a trial outside of it.
///
/// With multiplier 2 mu and h = v^2/(1-n^2) in [0, 1] the conditions of the minimum are
///
///   n = n*/(1 + 2 mu (1+h^2)/w.n),   v = v*/(1 + 4 mu h/w.v),   m = m* - mu/w.m
///
/// h = 1 is the edge m = 0, the ellipse n^2 + v^2 = 1, where more than a third of the
/// returns from far outside end. Elsewhere Newton solves for mu and h together, in two or
/// three steps next to the surface. Where that does not converge, f(mu), which falls
/// monotonically from f(0) > 0, is solved by Newton within a bracket, with one monotone
/// equation for h at each mu. This converges for all finite input; the result is on the
/// surface to round-off.
YieldPoint closest_point(const YieldPoint& trial, const EnergyNorm& w);

/// Return a trial state outside the yield surface to it, and update the damage.
///
/// @param old   effective loads before the step, rotated to the present contact frame
/// @param trial effective loads after an elastic step; the motion of the step is
///   (trial - old)/k
/// @param S     upscaling ratio of the pair [-]; u_c scales with it, Eq. 8
///
/// The loss is the work of the true loads over the step (trapezoidal rule) less the growth
/// of the stored energy: >= 0 for steps below the strength. The twisting moment is elastic,
/// carries the factor 1 - D, and does not enter f.
BondReturn return_bond(const DamageBond& b, const BondShape<double>& s, double S,
                       const BondState& state, const EffectiveLoads<double>& old,
                       const EffectiveLoads<double>& trial);

/// Strengths of one bond: N [N] by the sign of the load, V [N], M [N m].
struct BondStrength {
  double N, V, M;
};

inline BondStrength bond_strength(const DamageBond& b, const BondShape<double>& s, double N)
{
  return {(N > 0.0 ? b.sigma_t : b.sigma_c) * s.A, b.C * s.A,
          0.25 * b.sigma_t * s.A * s.R_b};
}

inline SingleStrengths single_strengths(const DamageBond& b, const BondShape<double>& s)
{
  const BondStrength in_tension = bond_strength(b, s, 1.0),
                     in_compression = bond_strength(b, s, -1.0);
  return {in_tension.N, in_compression.N, in_tension.V, in_tension.M};
}

/// The largest term of the yield function under the effective loads at breakage: m is
/// bending, n^2 is tension or compression by the sign of N, v^4/(1 - n^2) is shear (v^2 on
/// the edge m = 0 and beyond, where f is continued).
BreakMode break_mode(const DamageBond& b, const BondShape<double>& s,
                     const EffectiveLoads<double>& q);

/// The continued yield function under these effective loads [-].
double yield_value(const DamageBond& b, const BondShape<double>& s,
                   const EffectiveLoads<double>& q);

} // namespace mergel::dem
