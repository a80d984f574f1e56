#include "dem/specimen/psd.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

/// Share of a density d^(e-1) on [a, b] that lies below d.
double power_share(double a, double b, double e, double d)
{
  if (b <= a) return d < a ? 0.0 : 1.0;
  d = std::clamp(d, a, b);
  const double whole = std::log(b / a); // > 0
  if (e == 0.0) return std::log(d / a) / whole;
  return std::expm1(e * std::log(d / a)) / std::expm1(e * whole);
}

/// The inverse of power_share.
double power_quantile(double a, double b, double e, double u)
{
  if (b <= a) return a;
  const double whole = std::log(b / a);
  const double part = e == 0.0 ? u * whole : std::log1p(u * std::expm1(e * whole)) / e;
  return std::clamp(a * std::exp(part), a, b);
}

/// Share of a normal density about `mean` in ln d, cut to [a, b], that lies below d.
double normal_share(double a, double b, double mean, double spread, double d)
{
  if (d <= a) return 0.0;
  if (d >= b) return 1.0;
  // From the side of the shorter tail: a bound far from the mean then loses no digits.
  const auto z = [&](double x) { return (std::log(x) - mean) / (std::sqrt(2.0) * spread); };
  const double sign = z(a) > 0.0 ? -1.0 : 1.0;
  const auto Phi = [&](double x) { return 0.5 * std::erfc(-sign * z(x)); };
  return (Phi(d) - Phi(a)) / (Phi(b) - Phi(a));
}

/// The argument at which the ascending f, between a and b, is u.
template <class F>
double bisect(double a, double b, double u, F&& f)
{
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (a + b);
    (f(middle) < u ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

constexpr double by_number = -3.0; // exponent; the mass of a particle grows as d^3

void check_bounds(double d_min, double d_max)
{
  require(d_min > 0.0 && d_max >= d_min && std::isfinite(d_max),
          "particle diameters must be positive and in ascending order");
}

struct Check {
  void operator()(const UniformSizes& c) const { check_bounds(c.d_min, c.d_max); }
  void operator()(const PowerSizes& c) const
  {
    check_bounds(c.d_min, c.d_max);
    require(c.exponent > 0.0, "the exponent of a grading must be positive");
  }
  void operator()(const LogNormalSizes& c) const
  {
    check_bounds(c.d_min, c.d_max);
    require(c.d_50 > 0.0 && c.spread > 0.0,
            "a log-normal grading needs a median and a spread above 0");
    constexpr double tail = 1e-6;
    const auto share = [&](double mean) {
      const auto Phi = [&](double d) {
        return 0.5 * std::erfc((mean - std::log(d)) / (std::sqrt(2.0) * c.spread));
      };
      return Phi(c.d_max) - Phi(c.d_min);
    };
    const double mean = std::log(c.d_50);
    require(share(mean) > tail && share(mean + by_number * c.spread * c.spread) > tail,
            "almost no particle of this log-normal grading lies between its bounds: move "
            "them towards the median, or lower the spread");
  }
  void operator()(const SieveSizes& c) const
  {
    require(c.d.size() >= 2 && c.passing.size() == c.d.size(),
            "a sieve curve needs two points at least");
    for (std::size_t k = 0; k < c.d.size(); ++k) {
      require(c.d[k] > 0.0 && std::isfinite(c.d[k]), "diameters must be positive");
      require(k == 0 || c.d[k] > c.d[k - 1], "diameters must ascend");
      require(k == 0 || c.passing[k] >= c.passing[k - 1], "passing must not fall");
    }
    require(c.passing.front() == 0.0 && c.passing.back() == 1.0,
            "passing must go from 0 to 1");
  }
};

/// Segment of a sieve curve in which `value` lies, by its first point; `share`: its
/// ordinates.
std::size_t segment(const std::vector<double>& share, double value)
{
  const auto above = std::upper_bound(share.begin(), share.end(), value);
  const auto k = static_cast<std::size_t>(above - share.begin());
  return std::clamp<std::size_t>(k, 1, share.size() - 1) - 1;
}

} // namespace

Grading::Grading(SizeCurve curve) : curve_(std::move(curve))
{
  std::visit(Check{}, curve_);
  if (const auto* c = std::get_if<SieveSizes>(&curve_)) {
    // Number of a segment: integral of dP/d^3 with dP = rise dln(d)/ln(b/a).
    number_.assign(c->d.size(), 0.0);
    for (std::size_t k = 1; k < c->d.size(); ++k) {
      const double a = c->d[k - 1], b = c->d[k];
      number_[k] = number_[k - 1] + (c->passing[k] - c->passing[k - 1]) / std::log(b / a) *
                                        (std::pow(a, by_number) - std::pow(b, by_number));
    }
    const double whole = number_.back(); // > 0: passing rises from 0 to 1
    for (double& share : number_) share /= whole;
  }
  constexpr int n = 2000; // midpoint rule in u: relative error 1e-7, 1e-4 for steep curves
  double sum[4] = {0.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < n; ++k) {
    const double d = diameter((k + 0.5) / n) / largest();
    sum[1] += d;
    sum[2] += d * d;
    sum[3] += d * d * d;
  }
  for (int k = 1; k < 4; ++k) moment_[k] = sum[k] / n * std::pow(largest(), k);
}

double Grading::smallest() const
{
  return std::visit(
      [](const auto& c) {
        if constexpr (requires { c.d_min; })
          return c.d_min;
        else
          return c.d[segment(c.passing, 0.0)]; // nothing is finer
      },
      curve_);
}

double Grading::largest() const
{
  return std::visit(
      [](const auto& c) {
        if constexpr (requires { c.d_max; })
          return c.d_max;
        else
          return c.d[static_cast<std::size_t>(
              std::lower_bound(c.passing.begin(), c.passing.end(), 1.0) -
              c.passing.begin())];
      },
      curve_);
}

namespace {

struct Passing {
  double d;

  double operator()(const UniformSizes& c) const
  {
    return power_share(c.d_min, c.d_max, 1.0 - by_number, d);
  }
  double operator()(const PowerSizes& c) const
  {
    return power_share(c.d_min, c.d_max, c.exponent, d);
  }
  double operator()(const LogNormalSizes& c) const
  {
    return normal_share(c.d_min, c.d_max, std::log(c.d_50), c.spread, d);
  }
  double operator()(const SieveSizes& c) const
  {
    if (d <= c.d.front()) return 0.0;
    if (d >= c.d.back()) return 1.0;
    const std::size_t k = segment(c.d, d);
    return c.passing[k] +
           (c.passing[k + 1] - c.passing[k]) * power_share(c.d[k], c.d[k + 1], 0.0, d);
  }
};

struct NumberBelow {
  double d;
  const std::vector<double>& number;

  double operator()(const UniformSizes& c) const
  {
    return power_share(c.d_min, c.d_max, 1.0, d);
  }
  double operator()(const PowerSizes& c) const
  {
    return power_share(c.d_min, c.d_max, c.exponent + by_number, d);
  }
  double operator()(const LogNormalSizes& c) const
  {
    const double mean = std::log(c.d_50) + by_number * c.spread * c.spread;
    return normal_share(c.d_min, c.d_max, mean, c.spread, d);
  }
  double operator()(const SieveSizes& c) const
  {
    if (d <= c.d.front()) return 0.0;
    if (d >= c.d.back()) return 1.0;
    const std::size_t k = segment(c.d, d);
    return number[k] +
           (number[k + 1] - number[k]) * power_share(c.d[k], c.d[k + 1], by_number, d);
  }
};

struct Diameter {
  double u;
  const std::vector<double>& number;

  double operator()(const UniformSizes& c) const
  {
    return c.d_min + (c.d_max - c.d_min) * u;
  }
  double operator()(const PowerSizes& c) const
  {
    return power_quantile(c.d_min, c.d_max, c.exponent + by_number, u);
  }
  double operator()(const LogNormalSizes& c) const
  {
    return bisect(c.d_min, c.d_max, u, [&](double d) { return NumberBelow{d, number}(c); });
  }
  double operator()(const SieveSizes& c) const
  {
    const std::size_t k = segment(number, u);
    const double rise = number[k + 1] - number[k];
    const double part = rise > 0.0 ? std::clamp((u - number[k]) / rise, 0.0, 1.0) : 0.0;
    return power_quantile(c.d[k], c.d[k + 1], by_number, part);
  }
};

} // namespace

double Grading::passing(double d) const
{
  return std::visit(Passing{d}, curve_);
}

double Grading::number_below(double d) const
{
  return std::visit(NumberBelow{d, number_}, curve_);
}

double Grading::diameter(double u) const
{
  return std::visit(Diameter{u, number_}, curve_);
}

double Grading::sieve(double share) const
{
  return bisect(smallest(), largest(), share, [&](double d) { return passing(d); });
}

double Grading::mean_cube(double g) const
{
  return moment_[3] + g * (3.0 * moment_[2] + g * (3.0 * moment_[1] + g));
}

} // namespace mergel::dem
