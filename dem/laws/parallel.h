/// Elastic-brittle parallel bond of Potyondy and Cundall (2004), A bonded-particle model
/// for rock, Int. J. Rock Mech. Min. Sci. 41, 1329, Eqs. 12-16.
///
///   elastic   N = k_n0 A u_n,  V += k_s0 A du_s,  M += k_n0 I dtheta,  T += k_s0 J dphi
///   stresses  sigma = N/A + |M| R_b/I          largest tension over the section
///             tau   = |V|/A + |T| R_b/J        largest shear
///   breaks    at once, where sigma >= sigma_c or tau >= tau_c
///
/// Departures from the source:
/// - The normal load follows from the gap, not from a sum of increments. Both agree, but a
///   sum drifts.
/// - Shear and bending stiffness follow from the modulus by Eq. 4 of the paper, with the
///   bond length R_i + R_j, as for every bond here.
/// - Later versions have a factor of the bending moment (beta) and friction in tau_c. The
///   source and this law have neither.
#pragma once

#include "dem/laws/bond_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

struct ParallelBond : BondSection {
  static constexpr const char* name = "parallel"; ///< name in case files and summaries

  double sigma_c = 0.0; ///< tensile strength of the cement [Pa], > 0
  double tau_c = 0.0;   ///< shear strength of the cement [Pa], > 0

  ParallelBond() { twist = Twist::elastic; } // as in the source

  /// @throws InputError when out of range
  void check() const
  {
    BondSection::check();
    require(sigma_c > 0.0 && tau_c > 0.0, "bond strengths must be positive");
  }
};

/// This law with all strengths times a factor.
inline ParallelBond with_strengths_times(double factor, ParallelBond b)
{
  b.sigma_c *= factor;
  b.tau_c *= factor;
  return b;
}

/// Largest stresses at the rim of the section [Pa].
template <class Real>
struct RimStress {
  Real sigma; ///< tension positive
  Real tau;
};
template <class Real>
[[gnu::always_inline]] inline RimStress<Real> rim_stress(const BondShape<Real>& s,
                                                         const EffectiveLoads<Real>& q)
{
  const Real inv_AR = 1.0 / (s.A * s.R_b); // R_b/I = 4/(A R_b), R_b/J = 2/(A R_b)
  return {(q.N * s.R_b + 4.0 * sqrt(dot(q.M, q.M))) * inv_AR,
          (sqrt(dot(q.V, q.V)) * s.R_b + 2.0 * select(q.T < Real{}, -q.T, q.T)) * inv_AR};
}

template <class Real>
[[gnu::always_inline]] inline auto
is_elastic(const ParallelBond& b, const BondShape<Real>& s, const EffectiveLoads<Real>& q)
{
  const RimStress<Real> at = rim_stress(s, q);
  return (at.sigma < b.sigma_c) & (at.tau < b.tau_c);
}

inline SingleStrengths single_strengths(const ParallelBond& b, const BondShape<double>& s)
{
  return {b.sigma_c * s.A, std::numeric_limits<double>::infinity(), b.tau_c * s.A,
          0.25 * b.sigma_c * s.A * s.R_b};
}

/// Larger of sigma/sigma_c and tau/tau_c, less 1 [-].
inline double yield_value(const ParallelBond& b, const BondShape<double>& s,
                          const EffectiveLoads<double>& q)
{
  const RimStress<double> at = rim_stress(s, q);
  return std::max(at.sigma / b.sigma_c, at.tau / b.tau_c) - 1.0;
}

/// Shear where tau is nearer to its strength than sigma; else bending or tension, whichever
/// gives the larger part of sigma.
inline BreakMode break_mode(const ParallelBond& b, const BondShape<double>& s,
                            const EffectiveLoads<double>& q)
{
  const RimStress<double> at = rim_stress(s, q);
  if (at.tau * b.sigma_c > at.sigma * b.tau_c) return BreakMode::shear;
  const double bending = 4.0 * sqrt(dot(q.M, q.M));
  return bending > q.N * s.R_b ? BreakMode::bending : BreakMode::tension;
}

/// The bond breaks and releases the energy that it stored. Nothing here depends on S.
inline BondReturn return_bond(const ParallelBond&, const BondShape<double>& s, double,
                              const BondState& state, const EffectiveLoads<double>& old,
                              const EffectiveLoads<double>& trial)
{
  // stored q1.q1/2k less the work not done q1.(q1 - q0)/2k is q0.q1/2k
  return {trial, {state.u_p, 0.0}, 0.0, 0.5 * mutual_energy(s, old, trial)};
}

} // namespace mergel::dem
