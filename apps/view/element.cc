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

void name_stages(PlotQuantity& quantity, const Stages& stages)
{
  const bool is_counted = std::find(counted_strains.begin(), counted_strains.end(),
                                    quantity.name) != counted_strains.end();
  if (is_counted && !stages.is_all())
    quantity.words += " from stage " +
                      name_of_stage(stages.first, stages.first_part, stages.first_cycle) +
                      " on";
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
