/// Moduli, strengths and critical states from the curves of an element test. Compression
/// positive.
#pragma once

#include "dem/notation.h"

#include <optional>
#include <vector>

namespace mergel::dem {

/// Stress [Pa] against strain [-], in the order of the test.
struct Curve {
  std::vector<double> strain, stress;
};

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
/// (from, stress there), so that a bedding error before it does not count.
std::optional<CurvePoint> offset_yield(const Curve& c, double modulus, double offset,
                                       double from);

/// Largest stress, the first of equals. @pre the curve has a point
CurvePoint peak(const Curve& c);

/// Smallest stress after the peak; the peak itself if the curve ends there.
CurvePoint minimum_after_peak(const Curve& c);

/// The first peak from which the stress falls by more than this share of the peak before it
/// rises above it again: collapse of a bonded rock that hardens later.
std::optional<CurvePoint> first_collapse(const Curve& c, double share);

/// Mobilised friction angle of Mohr and Coulomb without cohesion [rad]: sin phi = (sigma_1
/// - sigma_3)/(sigma_1 + sigma_3), from the stresses along the axes, in any order. In
/// triaxial compression sin phi = 3 eta/(6 + eta), eta = q/p.
/// @pre none is a tension and one is positive
double friction_angle(const Vec3& stress);

struct StraightLine {
  double intercept, slope;
  double R2; ///< share of the variance of y that the line explains [-]
};

/// Least-squares line; none for fewer than two different x.
std::optional<StraightLine> fit_line(const std::vector<double>& x,
                                     const std::vector<double>& y);

/// Critical state: shear at constant stress and volume.
struct CriticalState {
  double p, q, e;
};

/// e = Gamma - lambda (p/p_a)^0.7, Li and Wang (1998), J. Geotech. Geoenviron. Eng. 124,
/// 1215, with p_a = 101325 Pa; slope is -lambda.
std::optional<StraightLine> critical_state_line(const std::vector<CriticalState>& states);

} // namespace mergel::dem
