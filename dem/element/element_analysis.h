/// Moduli, strengths and critical states from the curves of an element test. Compression
/// positive.
#pragma once

#include "dem/notation.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mergel::dem {

/// Stress [Pa] against strain [-], in the order of the test, without loops of unloading and
/// reloading.
struct Curve {
  std::vector<double> strain, stress;
  std::vector<std::size_t> loops{}; ///< points before which there was a loop, ascending

  bool is_after_loop(std::size_t point) const;
};

/// A fall of the stress by less than this share of its peak is no collapse [-].
inline constexpr double smallest_fall = 0.02;
/// A peak below this share of the largest stress of the curve is noise [-].
inline constexpr double smallest_peak = 0.1;

/// The curve without the ends of its reloadings: a reloading rejoins the curve from below, at a
/// strain beyond that of the unloading. After a loop the points up to the one that bears the
/// stress at the unloading again are left out; where none does, those up to the largest stress
/// before it falls by `smallest_fall`, or before the end.
Curve without_reloading(const Curve& c);

struct CurvePoint {
  double strain, stress;
};

/// Stress at which the strain first passes `strain`, linear between records; none if the
/// curve does not reach it.
std::optional<double> stress_at(const Curve& c, double strain);

/// Slope of the secant between two strains, from < to: a modulus if the stress is one
/// [Pa], Poisson's ratio if it is a lateral extension [-].
std::optional<double> secant(const Curve& c, double from, double to);

/// Offset yield strength: point at which the curve first falls below the line of slope
/// `modulus` that is moved by `offset` to larger strains. ASTM E8/E8M, as used for the
/// yield of bonded soils in isotropic, oedometer and triaxial compression by Leroueil and
/// Vaughan (1990), Geotechnique 40, 467. The line starts at the first point of the secant,
/// (from, stress there), so that a bedding error before it does not count. None where the curve
/// passes the line across a loop: that yield would be where the user has unloaded.
std::optional<CurvePoint> offset_yield(const Curve& c, double modulus, double offset,
                                       double from);

/// Largest stress, the first of equals. @pre the curve has a point
CurvePoint peak(const Curve& c);

/// A peak and the smallest stress between it and the next point that lies as high, or the
/// end of the curve: both belong to one fall of the stress. The last point before a loop is no
/// peak of the specimen: whoever unloads there ends a rise. A fall that has begun goes on behind a
/// loop, however small it is there; the end of a reloading between two loops counts in no fall.
struct Drop {
  CurvePoint peak, minimum;
};

/// That of the largest stress; peak and minimum are one point if the curve ends there, or is
/// unloaded.
/// @pre the curve has a point
Drop largest_drop(const Curve& c);

/// The first from whose peak the stress falls by more than this share of the peak: collapse
/// of a bonded rock that may harden later, beyond the peak. It may lie behind a larger stress at
/// which the specimen was unloaded. Peaks below `smallest_peak` of the largest stress do not count.
std::optional<Drop> first_drop(const Curve& c, double share);

/// Mobilised friction angle of Mohr and Coulomb without cohesion [rad]: sin phi = (sigma_1
/// - sigma_3)/(sigma_1 + sigma_3), from the stresses along the axes, in any order. In
/// triaxial compression sin phi = 3 eta/(6 + eta), eta = q/p.
/// @pre none is a tension and one is positive
double friction_angle(const Vec3& stress);

/// A line of least squares, y = intercept + slope x.
struct StraightLine {
  double intercept, slope;
  double R2; ///< share of the variance of y that the line explains [-]
  /// Of the estimates, from the scatter of y about the line, n - 2 degrees of freedom;
  /// NaN for two points, which have none.
  double intercept_variance, slope_variance, covariance;
};

/// Least-squares line; none for fewer than two different x.
std::optional<StraightLine> fit_line(const std::vector<double>& x,
                                     const std::vector<double>& y);

/// Critical state: shear at constant stress and volume.
struct CriticalState {
  double p, q, e;
};

inline constexpr double atmosphere = 101325.0;   ///< p_a [Pa]
inline constexpr double critical_exponent = 0.7; ///< of p/p_a

/// e = Gamma - lambda (p/p_a)^0.7, Li and Wang (1998), J. Geotech. Geoenviron. Eng. 124,
/// 1215; slope is -lambda.
std::optional<StraightLine> critical_state_line(const std::vector<CriticalState>& states);

} // namespace mergel::dem
