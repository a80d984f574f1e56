#include "apps/view/element.h"

#include "apps/view/round_off.h"
#include "dem/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

constexpr double negligible = 0.01; // |q| over the largest p
constexpr std::array<const char*, 2> counted_strains{"axial strain", "volumetric strain"};

/// Ratio of the edge (or volume) from which the strain of the stage counts to that from
/// which the strain of the whole test counts: 1 - whole = start (1 - of the stage).
double start(double whole, double of_stage)
{
  return (1.0 - whole) / (1.0 - of_stage); // > 0: at a strain of 1 there is no cell
}

bool is_of(const Stages& stages, double stage)
{
  return stage >= stages.first && (stages.last == 0 || stage <= stages.last);
}

PlotQuantity quantity(const std::string& name, const std::string& unit,
                      const Stages& stages)
{
  PlotQuantity q;
  q.name = q.words = name;
  q.unit = unit;
  name_stages(q, stages);
  return q;
}

PlotQuantity volumetric_strain(const Stages& stages)
{
  PlotQuantity q = quantity("volumetric strain", "%", stages);
  if (stages.is_all()) q.words += ", compression +"; // no room for both
  return q;
}

PlotQuantity void_ratio()
{
  PlotQuantity q = quantity("void ratio", "-", {});
  q.words = "void ratio e";
  return q;
}

} // namespace

bool is_element_history(const dem::Table& history)
{
  return history.has("stage") && history.has("p") && history.has("q") &&
         history.has("void ratio");
}

Stages stages_of(const std::string& text)
{
  Stages stages;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%d-%d%c", &stages.first, &stages.last, &rest);
  const bool is_one = n == 1 && text.find_first_not_of("0123456789") == std::string::npos;
  const bool is_range = n == 2 && stages.last >= stages.first;
  require(
      (is_one || is_range) && stages.first >= 1,
      "--stage " + text +
          ": must be the number of a stage, from which on to draw, or the first and the "
          "last of several: 2 or 2-3.");
  return stages;
}

dem::Table from_stages(const dem::Table& history, const Stages& stages)
{
  if (stages.is_all()) return history;
  const std::vector<double>& stage = history.column("stage", "-");
  std::array<const std::vector<double>*, 2> whole{}, of_stage{};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string name = counted_strains[k];
    whole[k] = &history.column(name, "-");
    of_stage[k] = &history.column(name + " of the stage", "-");
  }

  const auto start_of = [&](std::size_t k, std::size_t row) {
    return start((*whole[k])[row], (*of_stage[k])[row]);
  };
  const auto last = std::find(stage.rbegin(), stage.rend(), stages.first);
  const double longest = *std::max_element(stage.begin(), stage.end());
  require(last != stage.rend(), history.file.string() + ": no record of stage " +
                                    std::to_string(stages.first) + "; the last is " +
                                    std::to_string(std::lround(longest)) + ".");
  // During the approach to its stress a stage counts from another start.
  const auto anchor = static_cast<std::size_t>(stage.rend() - last - 1);
  const auto is_drawn = [&](std::size_t row) {
    if (!is_of(stages, stage[row])) return false;
    if (stage[row] > stages.first) return true;
    return std::abs(start_of(0, row) - start_of(0, anchor)) < round_off &&
           std::abs(start_of(1, row) - start_of(1, anchor)) < round_off;
  };

  dem::Table result = history;
  result.n_rows = 0;
  result.lines.clear();
  for (dem::TableColumn& column : result.columns) column.values.clear();
  for (std::size_t row = 0; row < history.n_rows; ++row) {
    if (!is_drawn(row)) continue;
    ++result.n_rows;
    result.lines.push_back(history.lines[row]);
    for (std::size_t c = 0; c < history.columns.size(); ++c) {
      double value = history.columns[c].values[row];
      for (std::size_t k = 0; k < 2; ++k)
        if (history.columns[c].name == counted_strains[k])
          value = 1.0 - (1.0 - value) / start_of(k, anchor); // > 0, as both cells are
      result.columns[c].values.push_back(value);
    }
  }
  return result;
}

void name_stages(PlotQuantity& quantity, const Stages& stages)
{
  const bool is_counted = std::find(counted_strains.begin(), counted_strains.end(),
                                    quantity.name) != counted_strains.end();
  if (is_counted && !stages.is_all())
    quantity.words += " from stage " + std::to_string(stages.first) + " on";
}

bool is_isotropic(const std::vector<Run>& runs)
{
  double q = 0.0, p = 0.0;
  for (const Run& run : runs) {
    for (const double value : run.history.column("q", "Pa"))
      if (std::isfinite(value)) q = std::max(q, std::abs(value));
    for (const double value : run.history.column("p", "Pa"))
      if (std::isfinite(value)) p = std::max(p, value);
  }
  return q < negligible * p;
}

std::vector<RunPlot> element_plots(const std::vector<Run>& runs, const Stages& stages)
{
  const PlotQuantity axial = quantity("axial strain", "%", stages),
                     q = quantity("q", "MPa", stages), p = quantity("p", "MPa", stages);
  std::vector<RunPlot> plots{plot_of(axial, q, runs),
                             plot_of(axial, volumetric_strain(stages), runs),
                             plot_of(p, q, runs), plot_of(p, void_ratio(), runs)};
  for (RunPlot& plot : plots) plot.x_reach = plot.y_reach = Reach::from_zero;
  plots.back().y_reach = Reach::of_values;
  return plots;
}

std::vector<RunPlot> isotropic_plots(const std::vector<Run>& runs, const Stages& stages)
{
  const PlotQuantity p = quantity("p", "MPa", stages);
  std::vector<RunPlot> plots{plot_of(volumetric_strain(stages), p, runs),
                             plot_of(p, void_ratio(), runs)};
  plots[0].x_reach = plots[0].y_reach = Reach::from_zero;
  plots[1].x_reach = Reach::decades;
  plots[1].y_reach = Reach::of_values;
  return plots;
}

} // namespace mergel::apps
