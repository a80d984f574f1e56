/// Bonds that are not all equally strong: each grain draws a factor of mean 1.
///
/// The paper names it (section 2.2.2, after Ciantia et al. 2014) as what keeps a loose rock from
/// collapsing at once when its bonds soften; it gives neither a distribution nor a width.
///
/// A factor is a function of seed and id alone: neither ranks nor the order of anything enter,
/// and no file has to keep it.
#pragma once

#include "dem/particles/particles.h"

namespace mergel::dem {

/// How the factors are distributed; their mean is 1.
struct StrengthVariability {
  enum class Distribution {
    none,
    log_normal,
    weibull ///< of two parameters: Weibull (1951), J. Appl. Mech. 18, 293
  };

  Distribution distribution = Distribution::none;
  double variation = 0.0; ///< coefficient of variation of the grains [-], in (0, 1]
  std::uint64_t seed = 1;

  bool is_on() const { return distribution != Distribution::none; }
  /// @throws InputError when out of range
  void check() const;
};

/// Draw p.strength for all grains; without variability it stays empty.
void draw_strengths(const StrengthVariability& v, Particles& p);

/// Shape of the Weibull distribution with this coefficient of variation [-]: 1 at 1.
double weibull_shape(double variation);

/// Factor of a bond between two grains, for sigma_t, sigma_c and C alike: their mean, as the
/// pair's S. The mean of all bonds stays 1, so that the strengths of the case stay what they
/// are calibrated for; their coefficient of variation is that of the grains over sqrt(2).
/// The weaker of the two would weaken a rock by 0.56 of the coefficient of variation.
/// @pre p.strength is not empty
inline double strength_between(const Particles& p, Index i, Index j)
{
  return 0.5 * (p.strength[i] + p.strength[j]);
}

/// Of a bond to what has no strength of its own: a wall, the grain's mirror image.
inline double strength_of(const Particles& p, Index i)
{
  return p.strength.empty() ? 1.0 : p.strength[i];
}

/// What was drawn.
struct StrengthSpread {
  double mean = 1.0, variation = 0.0; ///< coefficient of variation [-]
  double least = 1.0, greatest = 1.0;
};
StrengthSpread describe_strengths(const Particles& p);

} // namespace mergel::dem
