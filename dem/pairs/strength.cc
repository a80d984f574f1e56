#include "dem/pairs/strength.h"

#include "dem/error.h"
#include "dem/math/random.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

// Draws of random.h with no other use: the specimen may have been made from the same seed.
constexpr std::uint64_t first_draw = 1000, second_draw = 1001;

/// Uniform in (0, 1), without 0 and 1.
double inside_unit(std::uint64_t seed, std::uint64_t id, std::uint64_t draw)
{
  return uniform(seed, id, draw) + 0x1p-54;
}

/// exp(s z - s^2/2), s^2 = ln(1 + variation^2), z normal by Box and Muller (1958), Ann.
/// Math. Stat. 29, 610.
class LogNormal {
public:
  explicit LogNormal(double variation) : s_(std::sqrt(std::log1p(variation * variation))) {}
  double operator()(std::uint64_t seed, std::uint64_t id) const
  {
    const double z = std::sqrt(-2.0 * std::log(inside_unit(seed, id, first_draw))) *
                     std::cos(2.0 * pi * uniform(seed, id, second_draw));
    return std::exp(s_ * (z - 0.5 * s_));
  }

private:
  double s_;
};

/// (-ln u)^(1/k)/Gamma(1 + 1/k)
class Weibull {
public:
  explicit Weibull(double variation)
      : inv_k_(1.0 / weibull_shape(variation)), scale_(1.0 / std::tgamma(1.0 + inv_k_))
  {
  }
  double operator()(std::uint64_t seed, std::uint64_t id) const
  {
    return scale_ * std::pow(-std::log(inside_unit(seed, id, first_draw)), inv_k_);
  }

private:
  double inv_k_, scale_;
};

template <class Law>
void draw(const Law& law, std::uint64_t seed, Particles& p)
{
  p.strength.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) p.strength[i] = law(seed, p.id[i]);
}

} // namespace

void StrengthVariability::check() const
{
  if (is_on())
    require(variation > 0.0 && variation <= 1.0,
            "the coefficient of variation of the strengths must lie in (0, 1]");
}

double weibull_shape(double variation)
{
  // 1 + variation^2 = Gamma(1 + 2/k)/Gamma(1 + 1/k)^2 falls with k, from 2 at k = 1.
  const double wanted = std::log1p(variation * variation);
  double low = 1.0, high = 1.0;
  const auto at = [](double k) {
    return std::lgamma(1.0 + 2.0 / k) - 2.0 * std::lgamma(1.0 + 1.0 / k);
  };
  while (at(high) > wanted && high < 1e6) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double k = 0.5 * (low + high);
    (at(k) > wanted ? low : high) = k;
  }
  return 0.5 * (low + high);
}

void draw_strengths(const StrengthVariability& v, Particles& p)
{
  v.check();
  p.strength.clear();
  switch (v.distribution) {
  case StrengthVariability::Distribution::none:
    return;
  case StrengthVariability::Distribution::log_normal:
    return draw(LogNormal(v.variation), v.seed, p);
  case StrengthVariability::Distribution::weibull:
    return draw(Weibull(v.variation), v.seed, p);
  }
}

StrengthSpread describe_strengths(const Particles& p)
{
  StrengthSpread s;
  if (p.strength.empty()) return s;
  const auto n = static_cast<double>(p.strength.size());
  double sum = 0.0, squares = 0.0;
  for (const double f : p.strength) sum += f;
  s.mean = sum / n;
  for (const double f : p.strength) squares += (f - s.mean) * (f - s.mean);
  s.variation = std::sqrt(squares / n) / s.mean; // mean > 0: every factor is
  const auto [smallest, largest] =
      std::minmax_element(p.strength.begin(), p.strength.end());
  s.smallest = *smallest;
  s.largest = *largest;
  return s;
}

} // namespace mergel::dem
