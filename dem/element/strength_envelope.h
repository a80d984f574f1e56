/// The failure line of Mohr and Coulomb through several tests. Compression positive.
#pragma once

#include <optional>
#include <vector>

namespace mergel::dem {

/// Largest and smallest principal stress of one test, at failure or in the critical state
/// [Pa].
struct MohrCircle {
  double sigma_1, sigma_3;

  double centre() const { return 0.5 * (sigma_1 + sigma_3); }
  double radius() const { return 0.5 * (sigma_1 - sigma_3); }
};

/// tau = c + sigma tan(phi), touched by the circles in the mean.
struct CoulombLine {
  double c;                  ///< cohesion [Pa]
  double phi;                ///< friction angle [rad]
  double c_error, phi_error; ///< standard errors [Pa], [rad]; NaN for two tests
  double R2;                 ///< of sigma_1 over sigma_3 [-]
};

/// Regression of sigma_1 on sigma_3, which the test prescribes:
///
///   sigma_1 = b + N sigma_3,   sin phi = (N - 1)/(N + 1),   c = b/(2 sqrt(N)).
///
/// Standard errors to first order from the variances of b and N and their covariance.
/// None for fewer than two different sigma_3, and for N <= 0.
/// Source: ISRM (1983), Suggested methods for determining the strength of rock materials in
/// triaxial compression, Int. J. Rock Mech. Min. Sci. 20, 283.
std::optional<CoulombLine> coulomb_line(const std::vector<MohrCircle>& circles);

/// Critical state stress ratio M of q = M p.
struct StressRatio {
  double M;       ///< [-]
  double M_error; ///< standard error [-]; NaN for one state
};

/// Line of least squares through the origin; none without a p > 0.
std::optional<StressRatio> stress_ratio(const std::vector<double>& p,
                                        const std::vector<double>& q);

/// Friction angle [rad] of q/p = M in triaxial compression without cohesion, M > 0:
/// sin phi = 3 M/(6 + M).
double friction_angle_of_ratio(double M);

} // namespace mergel::dem
