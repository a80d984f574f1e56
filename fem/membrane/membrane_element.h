/// One triangle of a membrane: large rotations and stretches, no bending. Incompressible
/// neo-Hookean material in plane stress, with or without compression.
///
///   F = [x2 - x1, x3 - x1] D^-1           D the same edges at rest, in their plane
///   C = F^T F,   W = mu/2 (tr C + 1/det C - 3)                       carried
///   S = 2 dW/dC = mu (I - C^-1/det C)
///
/// A membrane without bending wrinkles where a principal stress would be compressive. Tension
/// field: with the principal stretches l1 >= l2,
///
///   taut      l2 >= l1^-1/2          S as above
///   wrinkled  l1 > 1, l2 < l1^-1/2   W = mu/2 (l1^2 + 2/l1 - 3),  S = mu (1 - l1^-3) N1 N1
///   slack     l1 <= 1                W = 0
///
/// Source: Pipkin (1986), The relaxed energy density for isotropic elastic membranes, IMA J.
/// Appl. Math. 36, 85; Treloar (1975), The Physics of Rubber Elasticity.
#pragma once

#include "fem/lanes.h"

#include <Eigen/Geometry>

namespace mergel::fem {

/// What a membrane does under compression.
enum class Compression {
  wrinkles, ///< it carries none: tension field
  carried   ///< as the material does
};

/// A triangle at rest. With the first edge along the first axis of its plane D is upper
/// triangular, and so is its inverse.
template <class Real>
struct RestTriangle {
  Real i11, i12, i22; ///< D^-1 [1/m]
  Real volume;        ///< area times thickness [m^3]
};

/// @param a, b edges from the first corner, at rest [m], not parallel; @param t0 thickness [m]
inline RestTriangle<double> rest_triangle(const Eigen::Vector3d& a,
                                          const Eigen::Vector3d& b, double t0)
{
  const double a1 = a.norm(), b1 = a.dot(b) / a1, area2 = a.cross(b).norm(),
               b2 = area2 / a1;
  return {1.0 / a1, -b1 / (a1 * b2), 1.0 / b2, 0.5 * area2 * t0};
}

/// Principal stretches of a triangle, l1 >= l2 [-], and what it does.
template <class Real, class Condition>
struct MembraneStretch {
  Real l1, l2;
  Condition is_taut, is_slack; ///< neither: wrinkled
};

/// Stress of a triangle: components in the axes of its plane at rest.
template <class Real>
struct MembraneStress {
  Real S11, S22, S12; ///< second Piola-Kirchhoff [Pa]
  Real W;             ///< energy over the volume [J/m^3]
};

/// F and C of a triangle.
template <class Real>
struct MembraneStrain {
  Vector<Real> F1, F2; ///< columns of F
  Real C11, C22, C12, det;

  /// @param a, b edges from the first corner [m]
  [[gnu::always_inline]] MembraneStrain(const RestTriangle<Real>& rest,
                                        const Vector<Real>& a, const Vector<Real>& b)
      : F1(a * rest.i11), F2(a * rest.i12 + b * rest.i22), C11(dot(F1, F1)),
        C22(dot(F2, F2)), C12(dot(F1, F2)), det(C11 * C22 - C12 * C12)
  {
  }

  [[gnu::always_inline]] auto stretch(Compression compression) const
  {
    const Real zero{}, mean = 0.5 * (C11 + C22), half = 0.5 * (C11 - C22),
                       l1_2 = mean + square_root(half * half + C12 * C12),
                       l1 = square_root(l1_2), l2_2 = det / l1_2;
    const auto is_taut =
        compression == Compression::carried ? l1_2 >= zero : det * l1 >= l1_2;
    // Round-off may leave the determinant of a flattened triangle below zero.
    return MembraneStretch<Real, decltype(l1_2 > zero)>{
        l1, square_root(choose(l2_2 > zero, l2_2, zero)), is_taut, l1_2 <= 1.0};
  }

  [[gnu::always_inline]] MembraneStress<Real> stress(double mu,
                                                     Compression compression) const
  {
    const auto now = stretch(compression);
    const Real zero{}, inv = 1.0 / det, inv2 = inv * inv;
    const MembraneStress<Real> taut{mu * (1.0 - C22 * inv2), mu * (1.0 - C11 * inv2),
                                    mu * C12 * inv2, 0.5 * mu * (C11 + C22 + inv - 3.0)};
    // N1 N1 = (C - l2^2 I)/(l1^2 - l2^2); where it wrinkles, l1 > 1 > l2.
    const Real l1_2 = now.l1 * now.l1, l2_2 = now.l2 * now.l2, inv_l1 = 1.0 / now.l1,
               along = mu * (1.0 - inv_l1 * inv_l1 * inv_l1) / (l1_2 - l2_2);
    const MembraneStress<Real> wrinkled{along * (C11 - l2_2), along * (C22 - l2_2),
                                        along * C12,
                                        0.5 * mu * (l1_2 + 2.0 * inv_l1 - 3.0)};
    const auto of_state = [&](const Real& if_taut, const Real& if_wrinkled) {
      return choose(now.is_taut, if_taut, choose(now.is_slack, zero, if_wrinkled));
    };
    return {of_state(taut.S11, wrinkled.S11), of_state(taut.S22, wrinkled.S22),
            of_state(taut.S12, wrinkled.S12), of_state(taut.W, wrinkled.W)};
  }
};

/// Forces on the corners of a triangle [N].
template <class Real>
struct CornerForces {
  Vector<Real> at[3];
};

/// Of its stretch, -dW/dx, and of a pressure p on the side from which its corners run
/// clockwise: p dV/dx of the enclosed volume V, a third of p times the area vector for each
/// corner. On a closed surface resultant and moment vanish to round-off.
/// @param a, b edges from the first corner [m]; @param mu shear modulus, E/3 [Pa]
template <class Real>
[[gnu::always_inline]] inline CornerForces<Real>
corner_forces(const RestTriangle<Real>& rest, double mu, Compression compression, double p,
              const Vector<Real>& a, const Vector<Real>& b)
{
  const MembraneStrain<Real> strain(rest, a, b);
  const MembraneStress<Real> s = strain.stress(mu, compression);
  // dW/da, dW/db = V F S D^-T
  const Vector<Real> G1 = strain.F1 * s.S11 + strain.F2 * s.S12,
                     G2 = strain.F1 * s.S12 + strain.F2 * s.S22;
  const Vector<Real> on_a = (G1 * rest.i11 + G2 * rest.i12) * rest.volume,
                     on_b = G2 * (rest.i22 * rest.volume);
  const Real sixth = Real{} + p / 6.0;
  const Vector<Real> pressure = cross(a, b) * sixth;
  return {{pressure + on_a + on_b, pressure - on_a, pressure - on_b}};
}

} // namespace mergel::fem
