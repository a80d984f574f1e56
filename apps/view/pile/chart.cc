#include "apps/view/pile/chart.h"

#include "apps/view/curve.h"

#include <vector>

namespace mergel::apps {

namespace {

constexpr double averaging_window = 0.1; // pile diameters of travel
constexpr double Pa_per_MPa = 1e6;
const Colour pale_blue{0.66, 0.78, 0.89};
const Colour blue{0.05, 0.28, 0.55};
const Colour red{0.62, 0.10, 0.12};

} // namespace

void draw_load(Page& page, const dem::Table& history)
{
  const std::vector<double>& depth = history.column("depth/D_p", "-");
  std::vector<double> q_c = history.column("q_c", "Pa");
  const std::vector<double>& broken = history.column("bonds broken", "-");
  for (double& q : q_c) q /= Pa_per_MPa;
  const std::vector<double> mean = dem::moving_mean(depth, q_c, averaging_window);

  const double u = page.unit();
  const double left = 140.0 * u, right = page.width() - 75.0 * u, gap = 60.0 * u;
  const double bottom = 60.0 * u, top = page.height() - 140.0 * u;
  const double middle = left + 0.6 * (right - left);

  const Range depths = range(depth);
  Panel load;
  load.box = {left, bottom, middle - 0.5 * gap, top};
  load.x = round_axis(range(q_c), "cone resistance (MPa)");
  load.y = {depths.high > depths.low ? depths.high : depths.low + 1.0, depths.low,
            "depth / pile diameter"};
  load.is_x_on_top = true;
  load.has_grid = true;
  draw_axes(page, load);
  draw_curve(page, load, q_c, depth, {pale_blue, 2.0, {}});
  draw_curve(page, load, mean, depth, {blue, 5.0, {}});

  const Pixel key{load.box.left + 40.0 * u, load.box.bottom + 95.0 * u};
  page.fill({key.x - 20.0 * u, key.y - 70.0 * u, key.x + 400.0 * u, key.y + 30.0 * u},
            {1.0, 1.0, 1.0});
  page.line({key, {key.x + 60.0 * u, key.y}}, pale_blue, 2.0);
  page.text({key.x + 80.0 * u, key.y}, "as recorded", {0.9, Across::left});
  page.line({{key.x, key.y - 40.0 * u}, {key.x + 60.0 * u, key.y - 40.0 * u}}, blue, 5.0);
  page.text({key.x + 80.0 * u, key.y - 40.0 * u}, "mean over 0.1 diameters",
            {0.9, Across::left});

  Panel bonds = load;
  bonds.box = {middle + 0.5 * gap, bottom, right, top};
  bonds.x = round_axis(range(broken), "broken bonds");
  bonds.y.title = "";
  bonds.has_y_numbers = false;
  draw_axes(page, bonds);
  draw_curve(page, bonds, broken, depth, {red, 5.0, {}});
}

} // namespace mergel::apps
