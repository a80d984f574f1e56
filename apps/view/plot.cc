#include "apps/view/plot.h"

#include "apps/view/round_off.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mergel::apps {

namespace {

constexpr double most_decades = 3.0;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// The 1, 2 or 5 times a power of ten next below (`up` false) or above a value > 0.
double round_125(double value, bool up)
{
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  double below = decade;
  for (const double round : {1.0, 2.0, 5.0, 10.0}) {
    if (up && round * decade >= value * (1.0 - round_off)) return round * decade;
    if (round * decade <= value * (1.0 + round_off)) below = round * decade;
  }
  return below;
}

Axis logarithmic_axis(const std::vector<double>& values, const std::string& title)
{
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value) || !(value > 0.0)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(high > 0.0)) return {0.1, 1.0, title, true};
  low = std::max(low, high * std::pow(10.0, -most_decades));
  Axis axis{round_125(low, false), round_125(high, true), title, true};
  if (!(axis.to > axis.from)) axis.to = 10.0 * axis.from;
  return axis;
}

Axis axis_of_values(const std::vector<double>& values, const std::string& title)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(low <= high)) return round_axis({}, title);
  if (high - low <= round_off * std::max(std::abs(low), std::abs(high))) { // a constant
    const double margin = low == 0.0 ? 1.0 : 0.05 * std::abs(low);
    low -= margin;
    high += margin;
  }
  return round_axis({low, high}, title);
}

/// The values of one direction, of curves and points.
template <class Direction>
std::vector<double> all(const Plot& plot, Direction&& direction)
{
  std::vector<double> values;
  const auto add = [&](const auto& part) {
    const std::vector<double>& v = direction(part);
    values.insert(values.end(), v.begin(), v.end());
  };
  for (const PlotCurve& curve : plot.curves) add(curve);
  for (const Scatter& scatter : plot.scatters) add(scatter);
  return values;
}

/// NaN for what lies below a logarithmic axis.
std::vector<double> shown(std::vector<double> values, const Axis& axis)
{
  if (axis.is_logarithmic)
    for (double& value : values)
      if (!(value >= axis.from * (1.0 - round_off))) value = NaN;
  return values;
}

void draw_band(Page& page, const Panel& panel, const PlotBand& band)
{
  for (std::size_t k = 1; k < band.x.size(); ++k) {
    const auto is_whole = [&](std::size_t row) {
      return std::isfinite(band.x[row]) && std::isfinite(band.low[row]) &&
             std::isfinite(band.high[row]);
    };
    if (!is_whole(k - 1) || !is_whole(k)) continue;
    page.fill({panel.at(band.x[k - 1], band.low[k - 1]), panel.at(band.x[k], band.low[k]),
               panel.at(band.x[k], band.high[k]),
               panel.at(band.x[k - 1], band.high[k - 1])},
              band.colour);
  }
}

bool has_both_signs(const Axis& axis)
{
  return axis.from < 0.0 && axis.to > 0.0;
}

} // namespace

Axis fitting_axis(const PlotAxis& axis, const std::vector<double>& values)
{
  switch (axis.reach) {
  case Reach::from_zero:
    return round_axis(range(values), axis.title);
  case Reach::of_values:
    return axis_of_values(values, axis.title);
  case Reach::downwards: {
    Axis downwards = round_axis(range(values), axis.title);
    std::swap(downwards.from, downwards.to);
    return downwards;
  }
  case Reach::decades:
    break;
  }
  return logarithmic_axis(values, axis.title);
}

void draw_plot(Page& page, const Box& box, const Plot& plot)
{
  const auto of_x = [](const auto& part) -> const auto&
  {
    return part.x;
  };
  const auto of_y = [](const auto& part) -> const auto&
  {
    return part.y;
  };
  std::vector<double> y = all(plot, of_y);
  for (const PlotBand& band : plot.bands) {
    y.insert(y.end(), band.low.begin(), band.low.end());
    y.insert(y.end(), band.high.begin(), band.high.end());
  }
  Panel panel;
  panel.box = box;
  panel.x = fitting_axis(plot.x, all(plot, of_x));
  panel.y = fitting_axis(plot.y, y);
  panel.has_grid = true;
  draw_axes(page, panel);

  for (const PlotBand& band : plot.bands) draw_band(page, panel, band);
  const Stroke zero{{0.55, 0.55, 0.55}, 2.0, {}};
  if (has_both_signs(panel.y))
    page.line({panel.at(panel.x.from, 0.0), panel.at(panel.x.to, 0.0)}, zero);
  if (has_both_signs(panel.x))
    page.line({panel.at(0.0, panel.y.from), panel.at(0.0, panel.y.to)}, zero);
  for (const PlotCurve& curve : plot.curves)
    draw_curve(page, panel, shown(curve.x, panel.x), shown(curve.y, panel.y), curve.stroke);
  for (const Scatter& scatter : plot.scatters) {
    const auto x = shown(scatter.x, panel.x), y = shown(scatter.y, panel.y);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (std::isfinite(x[k]) && std::isfinite(y[k]))
        draw_mark(page, panel.at(x[k], y[k]), scatter.mark, ink);
  }
}

} // namespace mergel::apps
