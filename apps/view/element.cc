#include "apps/view/element.h"

#include "dem/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

constexpr double negligible = 0.01; // |q| over the largest p
constexpr std::array<const char*, 2> counted_strains{"axial strain", "volumetric strain"};

/// Ratio of the edge (or volume) from which the strain of the leg counts to that from which
/// the whole strain does: 1 - whole = start (1 - of the leg).
double start(double whole, double of_leg)
{
  return (1.0 - whole) / (1.0 - of_leg); // no cell is strained by 1: it would be gone
}

bool is_of(const Legs& legs, double leg)
{
  return leg >= legs.first && (legs.last == 0 || leg <= legs.last);
}

Quantity quantity(const std::string& name, const std::string& unit, const Legs& legs)
{
  Quantity q;
  q.name = q.words = name;
  q.unit = unit;
  name_legs(q, legs);
  return q;
}

Quantity volumetric_strain(const Legs& legs)
{
  Quantity q = quantity("volumetric strain", "%", legs);
  if (legs.is_all()) q.words += ", compression +"; // no room for both
  return q;
}

Quantity void_ratio()
{
  Quantity q = quantity("void ratio", "-", {});
  q.words = "void ratio e";
  return q;
}

} // namespace

bool is_element_history(const dem::Table& history)
{
  return history.has("leg") && history.has("p") && history.has("q") &&
         history.has("void ratio");
}

Legs legs_of(const std::string& text)
{
  Legs legs;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%d-%d%c", &legs.first, &legs.last, &rest);
  const bool is_one = n == 1 && text.find_first_not_of("0123456789") == std::string::npos;
  const bool is_range = n == 2 && legs.last >= legs.first;
  require((is_one || is_range) && legs.first >= 1,
          "--leg " + text +
              ": must be the number of a leg, from which on to draw, or the first and the "
              "last of several: 2 or 2-3.");
  return legs;
}

dem::Table from_legs(const dem::Table& history, const Legs& legs)
{
  if (legs.is_all()) return history;
  const std::vector<double>& leg = history.column("leg", "-");
  std::array<const std::vector<double>*, 2> whole{}, of_leg{};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string name = counted_strains[k];
    whole[k] = &history.column(name, "-");
    of_leg[k] = &history.column(name + " of the leg", "-");
  }

  const auto start_of = [&](std::size_t k, std::size_t row) {
    return start((*whole[k])[row], (*of_leg[k])[row]);
  };
  const auto last = std::find(leg.rbegin(), leg.rend(), legs.first);
  const double longest = *std::max_element(leg.begin(), leg.end());
  require(last != leg.rend(), history.file.string() + ": no record of leg " +
                                  std::to_string(legs.first) + "; the last is " +
                                  std::to_string(std::lround(longest)) + ".");
  // While it goes to the stress it is to hold, a leg counts from another start.
  const auto anchor = static_cast<std::size_t>(leg.rend() - last - 1);
  constexpr double round_off = 1e-9;
  const auto is_drawn = [&](std::size_t row) {
    if (!is_of(legs, leg[row])) return false;
    if (leg[row] > legs.first) return true;
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

void name_legs(Quantity& quantity, const Legs& legs)
{
  const bool is_counted = std::find(counted_strains.begin(), counted_strains.end(),
                                    quantity.name) != counted_strains.end();
  if (is_counted && !legs.is_all())
    quantity.words += " from leg " + std::to_string(legs.first) + " on";
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

std::vector<RunPlot> element_plots(const std::vector<Run>& runs, const Legs& legs)
{
  const Quantity axial = quantity("axial strain", "%", legs),
                 q = quantity("q", "MPa", legs), p = quantity("p", "MPa", legs);
  std::vector<RunPlot> plots{plot_of(axial, q, runs),
                             plot_of(axial, volumetric_strain(legs), runs),
                             plot_of(p, q, runs), plot_of(p, void_ratio(), runs)};
  for (RunPlot& plot : plots) plot.x_reach = plot.y_reach = Reach::from_zero;
  plots.back().y_reach = Reach::of_values;
  return plots;
}

std::vector<RunPlot> isotropic_plots(const std::vector<Run>& runs, const Legs& legs)
{
  const Quantity p = quantity("p", "MPa", legs);
  std::vector<RunPlot> plots{plot_of(volumetric_strain(legs), p, runs),
                             plot_of(p, void_ratio(), runs)};
  plots[0].x_reach = plots[0].y_reach = Reach::from_zero;
  plots[1].x_reach = Reach::decades;
  plots[1].y_reach = Reach::of_values;
  return plots;
}

} // namespace mergel::apps
