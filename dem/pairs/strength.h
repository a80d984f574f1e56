/// Variable bond strengths: each particle draws a factor of mean 1 (dem/README.md, Strength
/// variability).
///
/// The paper (section 2.2.2, after Ciantia et al. 2014) gives this variability as the
/// reason why a loose rock does not collapse at once when its bonds soften. It gives
/// neither a distribution nor a width.
///
/// A factor is a function of seed and id alone: it does not depend on the number of ranks
/// or on any order, and no file stores it.
#pragma once

#include "dem/particles/particles.h"

namespace mergel::dem {

/// How the factors are distributed; their mean is 1.
struct StrengthVariability {
  enum class Distribution {
    none,
    log_normal,
    weibull ///< two parameters: Weibull (1951), J. Appl. Mech. 18, 293
  };

  Distribution distribution = Distribution::none;
  double variation = 0.0; ///< coefficient of variation of the particles [-], in (0, 1]
  std::uint64_t seed = 1;

  bool is_on() const { return distribution != Distribution::none; }
  /// @throws InputError when out of range
  void check() const;
};

/// Draw p.strength of all particles; it is empty without variability.
void draw_strengths(const StrengthVariability& v, Particles& p);

/// Shape of the Weibull distribution with this coefficient of variation [-]; 1 for 1.
double weibull_shape(double variation);

/// Factor of a bond between two particles, for sigma_t, sigma_c and C: the mean of theirs,
/// like S of a pair. The mean of all bonds is 1, so the calibrated strengths of a case
/// remain valid; the coefficient of variation of bonds is that of the particles over
/// sqrt(2). The smaller of the two factors would lower the mean strength by 0.56 of the
/// coefficient of variation.
/// @pre p.strength is not empty
inline double strength_between(const Particles& p, Index i, Index j)
{
  return 0.5 * (p.strength[i] + p.strength[j]);
}

/// Factor of a bond to a wall or to the particle's mirror image.
inline double strength_of(const Particles& p, Index i)
{
  return p.strength.empty() ? 1.0 : p.strength[i];
}

/// Statistics of the factors drawn [-].
struct StrengthSpread {
  double mean = 1.0, variation = 0.0; ///< coefficient of variation [-]
  double smallest = 1.0, largest = 1.0;
};
StrengthSpread describe_strengths(const Particles& p);

} // namespace mergel::dem
