/// Particle size distributions at an upscaling ratio of 1 (dem/README.md, Specimens).
///
/// Each curve gives the share by mass below a diameter, as a sieve does, and the share by
/// number, by which particles are drawn. Mass is proportional to number times d^3.
#pragma once

#include <variant>
#include <vector>

namespace mergel::dem {

/// Uniform by number between two bounds: the paper's rock, as far as its numbers fix the
/// distribution (meshes/psd/README.md).
struct UniformSizes {
  double d_min = 0.0, d_max = 0.0; ///< [m]
};

/// Power law by mass, P(d) = (d^e - d_min^e)/(d_max^e - d_min^e). e = 1/2: Fuller and
/// Thompson (1907), Trans. ASCE 59, 67; any e: Talbot and Richart (1923), Univ. Illinois
/// Bull. 137.
struct PowerSizes {
  double d_min = 0.0, d_max = 0.0; ///< [m]
  double exponent = 0.5;           ///< e [-], > 0
};

/// ln d normal by mass, cut off at two bounds. Its share by number is log-normal too, about
/// ln d_50 - 3 spread^2: Hatch and Choate (1929), J. Franklin Inst. 207, 369.
struct LogNormalSizes {
  double d_min = 0.0, d_max = 0.0; ///< [m]
  double d_50 = 0.0;               ///< median by mass before the cut [m]
  double spread = 0.0;             ///< standard deviation of ln d [-], > 0
};

/// A sieve curve, linear in ln d between its points, as such curves are drawn.
struct SieveSizes {
  std::vector<double> d;       ///< [m], ascending
  std::vector<double> passing; ///< by mass [-], from 0 to 1, never decreasing
};

using SizeCurve = std::variant<UniformSizes, PowerSizes, LogNormalSizes, SieveSizes>;

/// A size distribution from which diameters are drawn.
class Grading {
public:
  Grading() : Grading(UniformSizes{1.0, 1.0}) {}
  /// @throws InputError when the curve is not valid
  explicit Grading(SizeCurve curve);

  double smallest() const; ///< smallest diameter, d00 [m]
  double largest() const;  ///< largest diameter [m]

  double passing(double d) const;      ///< share by mass below d [-]
  double number_below(double d) const; ///< share by number below d [-]
  /// Diameter below which the share u by number lies [m]; u in [0, 1].
  double diameter(double u) const;
  /// Diameter below which this share by mass lies, for example d_50 [m].
  double sieve(double share) const;

  /// Mean of (d + g)^3 over the particles by number [m^3].
  double mean_cube(double g = 0.0) const;

private:
  SizeCurve curve_;
  std::vector<double> number_; ///< sieve curve: share by number below each point
  double moment_[4] = {1.0, 0.0, 0.0, 0.0}; ///< mean of d^k by number [m^k]
};

} // namespace mergel::dem
