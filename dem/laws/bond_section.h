/// What all bond laws share: the elastic section of the bond, its loads and their energy.
#pragma once

#include "dem/error.h"
#include "dem/math/simd.h"

#include <cstddef>

namespace mergel::dem {

/// Whether a bond resists twisting about its normal.
enum class Twist {
  none,   ///< as in the paper
  elastic ///< k_s0 J with J = 2 I
};

/// Elastic part of a bond, Eq. 4 of the paper (Potyondy and Cundall 2004).
struct BondSection {
  double E = 0.0;     ///< effective modulus [Pa], > 0
  double kappa = 1.0; ///< normal-to-shear stiffness ratio [-], > 0
  double lambda_b =
      1.0 / 3; ///< bond radius over the smaller particle radius [-], in (0, 1]
  Twist twist = Twist::none;

  /// @throws InputError when out of range
  void check() const
  {
    require(E > 0.0 && kappa > 0.0, "bond modulus and stiffness ratio must be positive");
    require(lambda_b > 0.0 && lambda_b <= 1.0, "bond radius ratio must lie in (0, 1]");
  }
};

/// Section and stiffness of one bond.
template <class Real>
struct BondShape {
  Real R_b; ///< bond radius [m]
  Real A;   ///< bond area [m^2]
  Real k_n; ///< k_n0 A [N/m]
  Real k_s; ///< k_s0 A [N/m]
  Real k_b; ///< bending stiffness k_n0 I, I = A R_b^2/4 [N m]
  Real k_t; ///< twisting stiffness k_s0 J, J = A R_b^2/2 [N m]; 0 without twist
};

/// @param r smaller radius [m]; @param inv_L one over the sum of radii [1/m]
template <class Real>
BondShape<Real> bond_shape(const BondSection& b, const Real& r, const Real& inv_L)
{
  BondShape<Real> s;
  s.R_b = b.lambda_b * r;
  s.A = pi * s.R_b * s.R_b;
  s.k_n = b.E * s.A * inv_L;
  s.k_s = s.k_n * (1.0 / b.kappa);
  s.k_b = 0.25 * s.k_n * s.R_b * s.R_b;
  s.k_t = (b.twist == Twist::elastic ? 0.5 : 0.0) * s.k_s * s.R_b * s.R_b;
  return s;
}

/// Loads of a bond divided by 1 - D, acting on i.
template <class Real>
struct EffectiveLoads {
  Real N;         ///< tension positive [N]
  Triple<Real> V; ///< [N]
  Triple<Real> M; ///< bending moment, normal to n [N m]
  Real T{};       ///< twisting moment about n [N m]
};

template <class Real>
EffectiveLoads<Real> operator*(const EffectiveLoads<Real>& q, const Real& factor)
{
  return {q.N * factor, q.V * factor, q.M * factor, q.T * factor};
}

/// q0.q1/k [J]: work of the constant load q0 on the elastic motion from no load to q1.
template <class Real>
Real mutual_energy(const BondShape<Real>& s, const EffectiveLoads<Real>& q0,
                   const EffectiveLoads<Real>& q1)
{
  const Real k_t = select(s.k_t > Real{}, s.k_t, Real{} + 1.0); // T is 0 without twist
  return q0.N * q1.N / s.k_n + dot(q0.V, q1.V) / s.k_s + dot(q0.M, q1.M) / s.k_b +
         q0.T * q1.T / k_t;
}

/// Energy of undamaged springs under these effective loads [J]; the bond stores 1 - D times
/// this.
template <class Real>
Real spring_energy(const BondShape<Real>& s, const EffectiveLoads<Real>& q)
{
  return 0.5 * mutual_energy(s, q, q);
}

/// Strengths of an undamaged bond under one load alone; infinite where it does not break.
struct SingleStrengths {
  double tension, compression, shear; ///< [N]
  double moment;                      ///< bending [N m]
};

/// The load that broke a bond: the largest one, by a measure that each law defines.
enum class BreakMode { tension, compression, shear, bending };
inline constexpr std::size_t n_break_modes = 4;

/// History of a bond in addition to its effective loads.
struct BondState {
  double u_p = 0.0;    ///< plastic normal displacement [m], signed
  double intact = 1.0; ///< 1 - D; 0 once broken
};

/// Result of an inelastic step.
struct BondReturn {
  EffectiveLoads<double> loads; ///< after the step; at breakage those that broke the bond
  BondState state;              ///< updated
  double loss = 0.0;            ///< energy dissipated by plasticity and damage [J]
  /// Energy released at bond breakage [J]: what the bond still stores, less the work that
  /// its load at the end of the step could not do (the second half of the trapezoid). 0 for
  /// a bond that does not break.
  double breakage_release = 0.0;
};

} // namespace mergel::dem
