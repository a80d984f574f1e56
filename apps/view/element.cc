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
constexpr std::array<const char*, 5> counted_strains{
    "axial strain", "volumetric strain", "axial strain of the middle third",
    "lateral strain of the middle third", "volumetric strain of the middle third"};
constexpr const char* volume_of_middle = counted_strains.back();

/// Ratio of the edge (or volume) from which the strain of the stage counts to that from
/// which the strain of the whole test counts: 1 - whole = start (1 - of the stage).
double start(double whole, double of_stage)
{
  return (1.0 - whole) / (1.0 - of_stage); // > 0: at a strain of 1 there is no cell
}

/// A strain of the whole test.
struct CountedStrain {
  std::size_t column;
  const std::vector<double>* whole;
  const std::vector<double>* of_stage; ///< null where the history has none for each stage

  double start(std::size_t row) const
  {
    return apps::start((*whole)[row], (*of_stage)[row]);
  }
};

/// Those of a history, the axial strain first.
/// @throws InputError when that, or its strain of the stage, is missing
std::vector<CountedStrain> counted_in(const dem::Table& history)
{
  history.column("axial strain", "-");
  history.column("axial strain of the stage", "-");
  std::vector<CountedStrain> strains;
  for (const std::string name : counted_strains) {
    const std::string of_stage = name + " of the stage";
    for (std::size_t c = 0; c < history.columns.size(); ++c)
      if (history.columns[c].name == name)
        strains.push_back(
            {c, &history.column(name, "-"),
             history.has(of_stage) ? &history.column(of_stage, "-") : nullptr});
  }
  return strains;
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

PlotQuantity volumetric_strain(const std::vector<Run>& runs, const Stages& stages)
{
  const bool is_of_middle = runs.front().history.has(volume_of_middle);
  PlotQuantity q = quantity("volumetric strain", "%", stages);
  if (stages.is_all()) // otherwise no room for both
    q.words += is_of_middle ? ", middle third" : ", compression +";
  if (is_of_middle) q.name = volume_of_middle;
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
         history.has("void ratio") && !is_triaxial_history(history);
}

bool is_triaxial_history(const dem::Table& history)
{
  return history.has("cell pressure") && history.has(volume_of_middle);
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
  const auto last = std::find(stage.rbegin(), stage.rend(), stages.first);
  const double longest = *std::max_element(stage.begin(), stage.end());
  require(last != stage.rend(), history.file.string() + ": no record of stage " +
                                    std::to_string(stages.first) + "; the last is " +
                                    std::to_string(std::lround(longest)) + ".");
  // During the approach to its stress a stage counts from another start.
  const auto anchor = static_cast<std::size_t>(stage.rend() - last - 1);
  const std::vector<CountedStrain> strains = counted_in(history);
  const auto counts_as_anchor = [&](std::size_t row) {
    return std::all_of(strains.begin(), strains.end(), [&](const CountedStrain& strain) {
      return !strain.of_stage ||
             std::abs(strain.start(row) - strain.start(anchor)) < round_off;
    });
  };
  const auto is_drawn = [&](std::size_t row) {
    return is_of(stages, stage[row]) &&
           (stage[row] > stages.first || counts_as_anchor(row));
  };
  // A strain without one of its own for each stage counts from the record at which the axial
  // strain of the stage began.
  std::size_t begin = 0;
  while (begin < anchor && !(counts_as_anchor(begin) &&
                             std::abs((*strains.front().of_stage)[begin]) < round_off))
    ++begin;

  dem::Table result = history;
  result.n_rows = 0;
  result.lines.clear();
  for (dem::TableColumn& column : result.columns) column.values.clear();
  for (std::size_t row = 0; row < history.n_rows; ++row) {
    if (!is_drawn(row)) continue;
    ++result.n_rows;
    result.lines.push_back(history.lines[row]);
    for (std::size_t c = 0; c < history.columns.size(); ++c)
      result.columns[c].values.push_back(history.columns[c].values[row]);
    for (const CountedStrain& strain : strains) {
      const double from =
          strain.of_stage ? strain.start(anchor) : 1.0 - (*strain.whole)[begin];
      double& value = result.columns[strain.column].values.back();
      value = 1.0 - (1.0 - value) / from; // > 0, as both cells are
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
                             plot_of(axial, volumetric_strain(runs, stages), runs),
                             plot_of(p, q, runs), plot_of(p, void_ratio(), runs)};
  for (RunPlot& plot : plots) plot.x_reach = plot.y_reach = Reach::from_zero;
  plots.back().y_reach = Reach::of_values;
  return plots;
}

std::vector<RunPlot> isotropic_plots(const std::vector<Run>& runs, const Stages& stages)
{
  const PlotQuantity p = quantity("p", "MPa", stages);
  std::vector<RunPlot> plots{plot_of(volumetric_strain(runs, stages), p, runs),
                             plot_of(p, void_ratio(), runs)};
  plots[0].x_reach = plots[0].y_reach = Reach::from_zero;
  plots[1].x_reach = Reach::decades;
  plots[1].y_reach = Reach::of_values;
  return plots;
}

} // namespace mergel::apps
