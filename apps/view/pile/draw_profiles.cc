#include "apps/view/pile/draw_profiles.h"

#include "apps/view/curve.h"
#include "apps/view/output.h"
#include "apps/view/plot.h"
#include "apps/view/round_off.h"
#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/table.h"

#include <cmath>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

constexpr double MPa = 1e-6;           // [1/Pa]
constexpr double caption_units = 60.0; // height of the strip above the panels

/// The lines of a profile at one time, and where `choose` is given, with this number there.
class Profile {
public:
  Profile(const dem::Table& table, double time, const char* choose = nullptr,
          double number = 0.0)
      : table_(table)
  {
    const auto& t = table.column("time", "s");
    for (std::size_t k = 0; k < t.size(); ++k)
      if (std::abs(t[k] - time) <= round_off * std::abs(time) &&
          (choose == nullptr || table.column(choose, "-")[k] == number))
        rows_.push_back(k);
  }
  bool is_empty() const { return rows_.empty(); }
  std::vector<double> values(const char* name, const char* unit, double factor = 1.0) const
  {
    const auto& all = table_.column(name, unit);
    std::vector<double> some;
    for (const std::size_t k : rows_) some.push_back(factor * all[k]);
    return some;
  }

private:
  const dem::Table& table_;
  std::vector<std::size_t> rows_;
};

/// None where the file is missing or has no line yet.
std::optional<dem::Table> profile_in(const fs::path& folder, const char* name)
{
  if (!dem::is_readable(folder / name)) return {};
  try {
    return dem::read_table(folder / name);
  } catch (const mergel::InputError&) { // a heading alone
    return {};
  }
}

Scatter marks(const std::vector<double>& x, const std::vector<double>& y, Mark mark)
{
  return {x, y, mark};
}

/// One panel with a curve and marks on it.
Plot plot_of(const std::vector<double>& x, const std::vector<double>& y,
             const std::string& x_title, const std::string& y_title, Reach x_reach,
             Reach y_reach)
{
  Plot plot;
  plot.x = {x_title, x_reach};
  plot.y = {y_title, y_reach};
  plot.curves.push_back({x, y, distinct_stroke(0)});
  plot.scatters.push_back(marks(x, y, Mark::disc));
  return plot;
}

/// Panels of a page below its caption and above its key.
void draw_plots(Page& page, const std::vector<Plot>& plots, const std::string& caption,
                const std::vector<KeyEntry>& key)
{
  const double u = page.unit();
  Grid places = grid(page, plots.size(), key);
  const double share = (page.height() - caption_units * u) / page.height();
  for (std::size_t k = 0; k < plots.size(); ++k) {
    Box box = places.boxes[k];
    box.top *= share;
    if (k + 2 < plots.size()) box.bottom *= share; // of an upper row
    draw_plot(page, box, plots[k]);
  }
  places.key.top *= share;
  draw_key(page, places.key, key);
  page.text({145.0 * u, page.height() - 18.0 * u}, caption, {0.9, Across::left, Up::head});
}

void draw_shaft(Page& page, const Profile& shaft, const std::string& caption)
{
  const auto h = shaft.values("h/R", "-");
  const auto radial = shaft.values("radial stress", "Pa", MPa);
  const std::string up = "height above the shoulder / R";
  Plot left = plot_of(radial, h, "radial stress on the shaft (MPa)", up, Reach::from_zero,
                      Reach::from_zero);
  std::vector<double> x, y;
  const auto by_icp = shaft.values("radial stress by Chalk ICP-18", "Pa", MPa);
  for (std::size_t k = 0; k < h.size(); ++k)
    if (h[k] >= 6.0) { // where the method holds
      x.push_back(by_icp[k]);
      y.push_back(h[k]);
    }
  std::vector<KeyEntry> key;
  if (!x.empty()) {
    left.curves.push_back({x, y, distinct_stroke(1)});
    left.scatters.push_back(marks(x, y, Mark::square));
    key = {{"this run", distinct_stroke(0), Mark::disc},
           {"Chalk ICP-18, end of driving, h/R \u2265 6 (constants from memory)",
            distinct_stroke(1), Mark::square}};
  }
  const Plot right =
      plot_of(shaft.values("shear stress", "Pa", MPa), h, "shear stress on the shaft (MPa)",
              up, Reach::from_zero, Reach::from_zero);
  draw_plots(page, {left, right}, caption, key);
}

void draw_rock(Page& page, const Profile& tip, const Profile& beside_tip,
               const Profile& beside_shaft, const std::string& caption)
{
  const auto below = tip.values("distance below the tip/D_p", "-");
  const std::string down = "depth below the tip / D";
  const std::string away = "distance from the axis / R";
  const auto radial = [&](const char* name, const std::string& title, Reach reach) {
    Plot plot = plot_of(beside_tip.values("r/R", "-"), beside_tip.values(name, "-"), away,
                        title, Reach::from_zero, reach);
    plot.curves[0].stroke = distinct_stroke(1);
    plot.scatters[0].mark = Mark::square;
    if (beside_shaft.is_empty()) return plot;
    const auto x = beside_shaft.values("r/R", "-"), y = beside_shaft.values(name, "-");
    plot.curves.push_back({x, y, distinct_stroke(2)});
    plot.scatters.push_back(marks(x, y, Mark::triangle));
    return plot;
  };
  std::vector<KeyEntry> key{
      {"below the tip, within R of the axis", distinct_stroke(0), Mark::disc},
      {"below the tip, D high", distinct_stroke(1), Mark::square}};
  if (!beside_shaft.is_empty())
    key.push_back({"along the shaft", distinct_stroke(2), Mark::triangle});
  draw_plots(page,
             {plot_of(tip.values("porosity", "-"), below, "porosity", down,
                      Reach::of_values, Reach::downwards),
              plot_of(tip.values("damage", "-"), below, "damage", down, Reach::from_zero,
                      Reach::downwards),
              radial("porosity", "porosity", Reach::of_values),
              radial("damage", "damage", Reach::from_zero)},
             caption, key);
}

/// State of a point that the tip passes, as far as a frame.
struct StressPath {
  std::vector<double> p, q, height; ///< [MPa]; of the point above the tip, over D
};

/// Of the points beside the shaft, by their depth over D; those with two states or more.
std::map<double, StressPath> paths_beside_shaft(const dem::Table& table, double time)
{
  const auto &t = table.column("time", "s"),
             &depth = table.column("depth of the point/D_p", "-"),
             &r = table.column("r/R", "-"),
             &height = table.column("height above the tip/D_p", "-"),
             &p = table.column("p", "Pa"), &q = table.column("q", "Pa");
  std::map<double, StressPath> paths;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const bool is_beside = r[k] > 1.0 && r[k] < 2.0;
    if (!is_beside || t[k] > time * (1.0 + round_off)) continue;
    StressPath& path = paths[depth[k]];
    path.p.push_back(MPa * p[k]);
    path.q.push_back(MPa * q[k]);
    path.height.push_back(height[k]);
  }
  std::erase_if(paths, [](const auto& at) { return at.second.p.size() < 2; });
  return paths;
}

void draw_paths(Page& page, const std::map<double, StressPath>& paths,
                const std::string& caption)
{
  Plot left, right;
  left.x = {"p (MPa)", Reach::from_zero};
  left.y = {"q (MPa)", Reach::from_zero};
  right.x = {"height of the point above the tip / D", Reach::of_values};
  right.y = {"p (MPa)", Reach::from_zero};
  std::vector<KeyEntry> key;
  for (const auto& [depth, path] : paths) {
    const Stroke stroke = distinct_stroke(key.size());
    left.curves.push_back({path.p, path.q, stroke});
    right.curves.push_back({path.height, path.p, stroke});
    std::ostringstream name;
    name << "beside the shaft, " << depth << " D deep";
    key.push_back({name.str(), stroke, Mark::none});
  }
  draw_plots(page, {left, right}, caption, key);
}

} // namespace

void draw_profiles(const Options& options, const fs::path& output, double time,
                   const std::string& caption)
{
  const fs::path folder = options.folders.front();
  const auto shaft = profile_in(folder, "shaft_profile.csv");
  if (shaft && !Profile(*shaft, time).is_empty()) {
    Page page(options.size.width, options.has_size ? options.size.height : 900);
    draw_shaft(page, Profile(*shaft, time), caption);
    save(page, output / "shaft.png");
  } else {
    std::cout << "no shaft.png: no ring of the shaft is whole below the surface\n";
  }
  const auto path = profile_in(folder, "stress_path.csv");
  if (const auto paths =
          path ? paths_beside_shaft(*path, time) : std::map<double, StressPath>{};
      !paths.empty()) {
    Page page(options.size.width, options.has_size ? options.size.height : 900);
    draw_paths(page, paths, caption);
    save(page, output / "paths.png");
  } else {
    std::cout << "no paths.png: the tip has not moved past a point of stress_path.csv\n";
  }
  const auto tip = profile_in(folder, "tip_profile.csv"),
             radial = profile_in(folder, "radial_profile.csv");
  if (!tip || !radial || Profile(*tip, time).is_empty()) return;
  const char* place = "beside the shaft 1 or below the tip 2";
  Page page(options.size.width, options.size.height);
  draw_rock(page, Profile(*tip, time), Profile(*radial, time, place, 2.0),
            Profile(*radial, time, place, 1.0), caption);
  save(page, output / "profiles.png");
}

} // namespace mergel::apps
