#include "apps/view/run_plot.h"

#include "apps/case/words.h"
#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mergel::apps {

namespace {

constexpr double pale = 0.25;         // of the colour of a stroke, in a band
constexpr double far_from_zero = 0.3; // lowest over highest value

/// Of the axis of a quantity over all runs.
Reach reach_of(const PlotQuantity& quantity, const std::vector<Run>& runs)
{
  if (quantity.is_logarithmic) return Reach::decades;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Run& run : runs)
    for (const double value : values_of(run.history, quantity)) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  const bool is_far = low > far_from_zero * high || high < far_from_zero * low;
  return low * high > 0.0 && is_far ? Reach::of_values : Reach::from_zero;
}

std::vector<KeyEntry> key(const std::vector<Run>& runs, const std::vector<Points>& points)
{
  std::vector<KeyEntry> entries;
  if (runs.size() > 1 || !points.empty())
    for (const Run& run : runs)
      entries.push_back({run.name.label, distinct_stroke(run.name.number)});
  for (const Points& p : points) entries.push_back({p.label, {ink, 0.0, {}}, p.mark});
  return entries;
}

} // namespace

RunPlot plot_of(PlotQuantity x, PlotQuantity y, const std::vector<Run>& runs)
{
  std::vector<const dem::Table*> histories;
  for (const Run& run : runs) histories.push_back(&run.history);
  settle(x, histories);
  settle(y, histories);
  const Reach x_reach = reach_of(x, runs), y_reach = reach_of(y, runs);
  return {std::move(x), std::move(y), x_reach, y_reach};
}

Plot plot_of_runs(const RunPlot& plot, const std::vector<Run>& runs)
{
  Plot result;
  result.x = {plot.x.title(), plot.x_reach};
  result.y = {plot.y.title(), plot.y_reach};
  for (const Run& run : runs) {
    const Stroke stroke = distinct_stroke(run.name.number);
    result.curves.push_back(
        {values_of(run.history, plot.x), values_of(run.history, plot.y), stroke});
    if (!run.error || plot.x.name != "axial strain" || !run.error->has(plot.y.name))
      continue;
    const PlotCurve& mean = result.curves.back();
    PlotBand band{mean.x, mean.y, mean.y, stroke.colour};
    const std::vector<double> error = values_of(*run.error, plot.y);
    for (std::size_t k = 0; k < error.size(); ++k) {
      band.low[k] -= error[k];
      band.high[k] += error[k];
    }
    for (double& part : band.colour) part = 1.0 - pale * (1.0 - part);
    result.bands.push_back(std::move(band));
  }
  return result;
}

void check_points(const std::vector<Points>& points, const std::vector<RunPlot>& plots)
{
  for (const Points& p : points) {
    bool is_shown = false;
    std::vector<std::string> pairs;
    for (const RunPlot& plot : plots) {
      is_shown = on_axes(p, plot.x, plot.y) || is_shown;
      pairs.push_back(in_quotes(plot.x.name + "," + plot.y.name));
    }
    require(is_shown, p.file.string() + ": " +
                          in_quotes(p.names[0].name + "," + p.names[1].name) +
                          " are the axes of no panel; there are " + joined(pairs, ", ") +
                          ". Name the columns so.");
  }
}

void draw_runs(Page& page, const std::vector<RunPlot>& plots, const std::vector<Run>& runs,
               const std::vector<Points>& points)
{
  const auto entries = key(runs, points);
  const Grid places = grid(page, plots.size(), entries);
  for (std::size_t k = 0; k < plots.size(); ++k) {
    Plot plot = plot_of_runs(plots[k], runs);
    for (const Points& p : points)
      if (const auto scatter = on_axes(p, plots[k].x, plots[k].y))
        plot.scatters.push_back(*scatter);
    draw_plot(page, places.boxes[k], plot);
  }
  draw_key(page, places.key, entries);
}

} // namespace mergel::apps
