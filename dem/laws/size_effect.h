/// Size effect: strengths as a function of the width of the specimen, Eqs. 17-19
/// (dem/README.md, Size effect).
#pragma once

#include <cmath>

namespace mergel::dem {

struct SizeEffect {
  double reference_width = 50e-3; ///< B_ref [m], > 0
  double psi = 1.1;               ///< at any width but the reference [-], > 0

  /// Exponent of Eq. 17, after Brown and Hoek (1980).
  static constexpr double exponent = 0.18;

  /// Factor of sigma_t, sigma_c and C: psi (B_ref/B)^0.18, and 1 at the reference width. A
  /// width within 1 % of the reference counts as the reference, because confining a cell
  /// changes its edges a little.
  /// @param B width of the specimen [m], > 0
  double factor(double B) const
  {
    if (std::abs(B / reference_width - 1.0) < 0.01) return 1.0;
    return psi * std::pow(reference_width / B, exponent);
  }
};

} // namespace mergel::dem
