/// Isotropic linear elasticity, small strain, tension positive.
#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace mergel::fem {

/// Young's modulus and Poisson's ratio, and the constants that follow from them.
struct Elastic {
  double E = 0.0;  ///< Young's modulus [Pa], > 0
  double nu = 0.0; ///< Poisson's ratio [-], -1 < nu < 0.5: no divisor below is zero

  double lambda() const { return E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)); } ///< [Pa]
  double G() const { return E / (2.0 * (1.0 + nu)); }                        ///< [Pa]

  /// Speed of a plane compression wave, sqrt((lambda + 2 G)/rho) [m/s]; rho > 0 [kg/m^3].
  double p_wave_speed(double rho) const { return std::sqrt((lambda() + 2.0 * G()) / rho); }
};

/// C of sigma = C : eps = lambda tr(eps) I + 2 G eps [Pa].
inline dealii::SymmetricTensor<4, 3> elasticity_tensor(const Elastic& e)
{
  const auto I = dealii::unit_symmetric_tensor<3>();
  return e.lambda() * dealii::outer_product(I, I) +
         2.0 * e.G() * dealii::identity_tensor<3>();
}

} // namespace mergel::fem
