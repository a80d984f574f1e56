#include "apps/view/pile/chart.h"

#include "apps/case/units.h"
#include "apps/view/curve.h"

#include <algorithm>

namespace mergel::apps {

namespace {

constexpr double averaging_window = 0.1; // pile diameters of travel
const Colour pale_blue{0.66, 0.78, 0.89};
const Colour blue{0.05, 0.28, 0.55};
const Colour red{0.62, 0.10, 0.12};
const Stroke thin{ink, 2.5, {}};
constexpr std::size_t most_marks = 25; // of one measured curve

/// A measured curve in the units of a panel, over depth in pile diameters.
struct MeasuredLoad {
  std::string quantity, unit; ///< "q_c", "MPa"
  std::vector<double> x, depth;
  std::size_t file; ///< its number
};

std::vector<MeasuredLoad> loads_of(const std::vector<Measured>& measured,
                                   const dem::Table& history)
{
  if (measured.empty()) return {};
  const std::vector<Run> runs{{{0, ""}, history}};
  const double depth = history.column("depth", "m").back(),
               tip_depth = history.column("tip depth", "m").back(),
               D = depth / history.column("depth/D_p", "-").back();
  std::vector<MeasuredLoad> loads;
  for (std::size_t k = 0; k < measured.size(); ++k)
    for (const RunPlot& panel : panels_of({measured[k]}, runs)) {
      const bool is_load = panel.x.name == "q_c" || panel.x.name == "head force";
      const std::string& of = panel.y.name;
      if (!is_load || (of != "depth" && of != "depth/D_p" && of != "tip depth")) continue;
      const PlotCurve curve = curve_in(panel, measured[k], runs);
      MeasuredLoad load{panel.x.name, panel.x.unit, curve.x, curve.y, k};
      if (of != "depth/D_p")
        for (double& y : load.depth)
          y = (y * unit_size(panel.y.unit, panel.y.base) -
               (of == "tip depth" ? tip_depth - depth : 0.0)) /
              D;
      loads.push_back(std::move(load));
    }
  return loads;
}

/// One quantity of the run over depth, as recorded and as a moving mean, and what was measured.
void draw_quantity(Page& page, Panel panel, const dem::Table& history,
                   PlotQuantity quantity, const std::vector<MeasuredLoad>& measured)
{
  settle(quantity, {&history});
  const auto values = values_of(history, quantity);
  const auto& depth = history.column("depth/D_p", "-");
  Range reach = range(values);
  for (const MeasuredLoad& m : measured)
    if (m.quantity == quantity.name) reach = range(reach, range(m.x));
  panel.x = round_axis(reach, quantity.title());
  draw_axes(page, panel);
  draw_curve(page, panel, values, depth, {pale_blue, 2.0, {}});
  draw_curve(page, panel, dem::moving_mean(depth, values, averaging_window), depth,
             {blue, 5.0, {}});
  for (const MeasuredLoad& m : measured) {
    if (m.quantity != quantity.name) continue;
    std::vector<double> x, y; // what lies deeper than the run is left out
    for (std::size_t k = 0; k < m.x.size(); ++k)
      if (m.depth[k] <= panel.y.from && m.depth[k] >= panel.y.to) {
        x.push_back(m.x[k]);
        y.push_back(m.depth[k]);
      }
    draw_curve(page, panel, x, y, thin);
    const std::size_t step = 1 + x.size() / most_marks;
    for (std::size_t k = 0; k < x.size(); k += step)
      draw_mark(page, panel.at(x[k], y[k]), distinct_mark(m.file), ink);
  }
}

PlotQuantity named(const char* name, const char* words)
{
  PlotQuantity quantity = quantity_of(name);
  quantity.words = words;
  return quantity;
}

} // namespace

void add_head_force(dem::Table& history)
{
  const char *tip = "tip force of the full pile", *shaft = "shaft force of the full pile";
  if (history.has("head force")) return;
  if (history.has("head force of the full pile")) {
    history.columns.push_back(
        {"head force", "N", history.column("head force of the full pile", "N")});
    return;
  }
  if (!history.has(tip) || !history.has(shaft)) return;
  dem::TableColumn head{"head force", "N", history.column(tip, "N")};
  const auto& more = history.column(shaft, "N");
  for (std::size_t k = 0; k < head.values.size(); ++k) head.values[k] += more[k];
  history.columns.push_back(std::move(head));
}

void draw_load(Page& page, const dem::Table& history, const std::vector<Measured>& measured)
{
  const auto loads = loads_of(measured, history);
  std::vector<KeyEntry> key{{"as recorded", {pale_blue, 2.0, {}}},
                            {"mean over 0.1 diameters", {blue, 5.0, {}}}};
  for (std::size_t k = 0; k < measured.size(); ++k)
    if (std::any_of(loads.begin(), loads.end(), [&](const auto& m) { return m.file == k; }))
      key.push_back({measured[k].label, thin, distinct_mark(k)});

  const double u = page.unit();
  const double left = 140.0 * u, right = page.width() - 75.0 * u, gap = 70.0 * u;
  const double strip = key_height(page, key, right - left);
  const double bottom = 40.0 * u, top = page.height() - strip - 150.0 * u;
  const double width = (right - left - 2.0 * gap) / 3.0;
  const std::vector<double>& depth = history.column("depth/D_p", "-");
  const Range depths = range(depth);
  const auto panel = [&](double place) {
    Panel p;
    const double x = left + place * (width + gap);
    p.box = {x, bottom, x + width, top};
    p.y = {depths.high > depths.low ? depths.high : depths.low + 1.0, depths.low,
           place == 0.0 ? "depth / pile diameter" : ""};
    p.is_x_on_top = true;
    p.has_grid = true;
    p.has_y_numbers = place == 0.0;
    return p;
  };
  draw_quantity(page, panel(0.0), history, named("q_c", "cone resistance"), loads);
  draw_quantity(page, panel(1.0), history, named("head force", "head force"), loads);

  const std::vector<double>& broken = history.column("bonds broken", "-");
  Panel bonds = panel(2.0);
  bonds.x = round_axis(range(broken), "broken bonds");
  draw_axes(page, bonds);
  draw_curve(page, bonds, broken, depth, {red, 5.0, {}});
  draw_key(page, {left, top, right, page.height() - 15.0 * u}, key);
}

} // namespace mergel::apps
