#include "apps/view/brazilian.h"

namespace mergel::apps {

namespace {

constexpr const char* index_stress = "2P/(pi D t)";

PlotQuantity quantity(const char* name, const char* unit)
{
  PlotQuantity q;
  q.name = q.words = name;
  q.unit = unit;
  return q;
}

} // namespace

bool is_brazilian_history(const dem::Table& history)
{
  return history.has(index_stress) && history.has("diametral strain");
}

std::vector<RunPlot> brazilian_plots(const std::vector<Run>& runs)
{
  const PlotQuantity strain = quantity("diametral strain", "%");
  const PlotQuantity stress = quantity(index_stress, "MPa");
  std::vector<RunPlot> plots{plot_of(strain, stress, runs),
                             plot_of(strain, quantity("broken bonds", "-"), runs)};
  for (RunPlot& plot : plots) plot.x_reach = plot.y_reach = Reach::from_zero;
  return plots;
}

} // namespace mergel::apps
