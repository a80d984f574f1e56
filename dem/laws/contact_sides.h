/// What all contact laws share: the two sides of a contact, its stiffness, and the result of
/// one step.
#pragma once

#include "dem/error.h"
#include "dem/math/simd.h"

namespace mergel::dem {

/// Sizes of the two sides, and how many of them deform.
template <class Real>
struct ContactSides {
  Real r;           ///< smaller radius [m]
  Real inv_L;       ///< one over the sum of radii [1/m]
  Real R_star;      ///< R_i R_j/(R_i + R_j) [m]
  double n_elastic; ///< 2, or 1 against a wall, which is rigid
};

/// @param inv_L one over the sum of radii [1/m]
template <class Real>
ContactSides<Real> sides_of_pair(const Real& R_i, const Real& R_j, const Real& inv_L)
{
  return {min(R_i, R_j), inv_L, R_i * R_j * inv_L, 2.0};
}
inline ContactSides<double> sides_of_pair(double R_i, double R_j)
{
  return sides_of_pair(R_i, R_j, 1.0 / (R_i + R_j));
}
/// A particle and its mirror image.
inline ContactSides<double> sides_at_mirror(double R)
{
  return {R, 0.5 / R, 0.5 * R, 2.0};
}
/// A particle and a wall of any shape: r = R and L = R.
template <class Real>
ContactSides<Real> sides_at_wall(const Real& R)
{
  return {R, 1.0 / R, R, 1.0};
}

/// Stiffnesses [N/m] of one contact.
template <class Real>
struct ContactStiffness {
  Real k_n, k_s;
};

/// Motion of the sides in the step that ends now.
template <class Real>
struct ContactMotion {
  Real gap;             ///< now [m]
  Real du_n;            ///< growth of the gap [m]
  Triple<Real> du_s;    ///< shear of j relative to i, normal to n [m]
  Triple<Real> f_s_old; ///< shear force of the last step, rotated with the contact [N]
};

/// Result of one step of a contact.
template <class Real>
struct ContactStep {
  Real f_n;         ///< compression [N], >= 0
  Triple<Real> f_s; ///< shear force on i, the new history [N]
  Real slip_loss;   ///< shear energy lost in this step [J]
};

} // namespace mergel::dem
