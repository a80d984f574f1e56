#include "dem/element/element_analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

/// Fraction between a and b at which the linear function from a to b is zero; a and b have
/// different signs, or a is 0.
double crossing(double a, double b)
{
  return a == b ? 0.0 : a / (a - b);
}

/// The point at which the reloading that begins at point `k` has ended.
std::size_t end_of_reloading(const Curve& c, std::size_t k)
{
  std::size_t top = k;
  for (std::size_t j = k; j < c.stress.size(); ++j) {
    if (c.stress[j] >= c.stress[k - 1]) return j;
    if (c.stress[j] > c.stress[top]) top = j;
    if (c.stress[j] < c.stress[top] - smallest_fall * std::abs(c.stress[top])) break;
  }
  return top;
}

} // namespace

bool Curve::is_after_loop(std::size_t point) const
{
  return std::binary_search(loops.begin(), loops.end(), point);
}

Curve without_reloading(const Curve& c)
{
  Curve kept;
  for (std::size_t k = 0; k < c.strain.size(); ++k) {
    if (k > 0 && c.is_after_loop(k)) {
      // A further loop may begin before this reloading has ended.
      const auto next = std::upper_bound(c.loops.begin(), c.loops.end(), k);
      const std::size_t end = end_of_reloading(c, k);
      k = next == c.loops.end() ? end : std::min(end, *next - 1);
      kept.loops.push_back(kept.strain.size());
    }
    kept.strain.push_back(c.strain[k]);
    kept.stress.push_back(c.stress[k]);
  }
  return kept;
}

std::optional<double> stress_at(const Curve& c, double strain)
{
  for (std::size_t k = 0; k < c.strain.size(); ++k) {
    if (c.strain[k] == strain) return c.stress[k];
    if (k == 0 || (c.strain[k - 1] - strain) * (c.strain[k] - strain) > 0.0) continue;
    const double t = crossing(c.strain[k - 1] - strain, c.strain[k] - strain);
    return c.stress[k - 1] + t * (c.stress[k] - c.stress[k - 1]);
  }
  return {};
}

std::optional<double> secant(const Curve& c, double from, double to)
{
  const auto a = stress_at(c, from), b = stress_at(c, to);
  if (!a || !b || from == to) return {};
  return (*b - *a) / (to - from);
}

std::optional<CurvePoint> offset_yield(const Curve& c, double modulus, double offset,
                                       double from)
{
  const auto base = stress_at(c, from);
  if (!base) return {};
  const auto above = [&](std::size_t k) { // stress of the curve minus the line [Pa]
    return c.stress[k] - (*base + modulus * (c.strain[k] - from - offset));
  };
  for (std::size_t k = 1; k < c.strain.size(); ++k) {
    if (c.strain[k] <= from + offset || above(k) > 0.0) continue;
    if (c.is_after_loop(k)) return {};
    const double before = above(k - 1);
    if (before <= 0.0) return CurvePoint{c.strain[k], c.stress[k]};
    const double t = crossing(before, above(k));
    return CurvePoint{c.strain[k - 1] + t * (c.strain[k] - c.strain[k - 1]),
                      c.stress[k - 1] + t * (c.stress[k] - c.stress[k - 1])};
  }
  return {};
}

CurvePoint peak(const Curve& c)
{
  const auto at = std::max_element(c.stress.begin(), c.stress.end());
  return {c.strain[static_cast<std::size_t>(at - c.stress.begin())], *at};
}

namespace {

/// Whether the curve was unloaded at this point: that ends a rise, and is no peak.
bool is_unloaded_at(const Curve& c, std::size_t point)
{
  return c.is_after_loop(point + 1);
}

/// Whether the point is of a reloading that a further loop has ended: the curve lies above it.
bool is_between_loops(const Curve& c, std::size_t point)
{
  return c.is_after_loop(point) && c.is_after_loop(point + 1);
}

/// The drop whose peak is point `top`.
Drop drop_from(const Curve& c, std::size_t top)
{
  std::size_t low = top;
  if (!is_unloaded_at(c, top))
    for (std::size_t k = top + 1; k < c.stress.size() && c.stress[k] < c.stress[top]; ++k)
      if (c.stress[k] < c.stress[low] && !is_between_loops(c, k)) low = k;
  return {{c.strain[top], c.stress[top]}, {c.strain[low], c.stress[low]}};
}

} // namespace

Drop largest_drop(const Curve& c)
{
  const auto top = std::max_element(c.stress.begin(), c.stress.end());
  return drop_from(c, static_cast<std::size_t>(top - c.stress.begin()));
}

std::optional<Drop> first_drop(const Curve& c, double share)
{
  if (c.stress.empty()) return {};
  const double noise = smallest_peak * peak(c).stress;
  std::size_t top = 0;
  for (std::size_t k = 1; k < c.stress.size(); ++k) {
    if (c.stress[k] >= c.stress[top] || (k == top + 1 && is_unloaded_at(c, top)))
      top = k;
    else if (c.stress[top] >= noise && c.stress[k] < (1.0 - share) * c.stress[top] &&
             !is_between_loops(c, k))
      return drop_from(c, top);
  }
  return {};
}

double friction_angle(const Vec3& stress)
{
  const double s1 = stress.maxCoeff(), s3 = stress.minCoeff();
  return std::asin((s1 - s3) / (s1 + s3));
}

std::optional<StraightLine> fit_line(const std::vector<double>& x,
                                     const std::vector<double>& y)
{
  const auto n = static_cast<double>(x.size());
  double x_mean = 0.0, y_mean = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    x_mean += x[k] / n;
    y_mean += y[k] / n;
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - x_mean) * (x[k] - x_mean);
    xy += (x[k] - x_mean) * (y[k] - y_mean);
    yy += (y[k] - y_mean) * (y[k] - y_mean);
  }
  if (!(xx > 0.0)) return {};
  const double slope = xy / xx;
  const double residual = std::max(0.0, yy - slope * xy); // sum of squares about the line
  const double NaN = std::numeric_limits<double>::quiet_NaN();
  const double variance = n > 2.0 ? residual / (n - 2.0) : NaN;
  return StraightLine{y_mean - slope * x_mean,
                      slope,
                      yy > 0.0 ? xy * xy / (xx * yy) : 1.0,
                      variance * (1.0 / n + x_mean * x_mean / xx),
                      variance / xx,
                      -variance * x_mean / xx};
}

std::optional<StraightLine> critical_state_line(const std::vector<CriticalState>& states)
{
  std::vector<double> x, e;
  for (const CriticalState& s : states) {
    x.push_back(std::pow(std::max(0.0, s.p) / atmosphere, critical_exponent));
    e.push_back(s.e);
  }
  return fit_line(x, e);
}

} // namespace mergel::dem
