#include "apps/view/laboratory/mohr.h"

#include "apps/view/laboratory/layout.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

constexpr double MPa = 1e6;

/// One scale for both axes, in which all circles are seen.
Panel panel_of(const Box& box, const StrengthFit& fit)
{
  double low = 0.0, high = 0.0, radius = 0.0;
  for (const dem::MohrCircle& m : fit.circles) {
    low = std::min(low, m.sigma_3 / MPa);
    high = std::max(high, m.sigma_1 / MPa);
    radius = std::max(radius, m.radius() / MPa);
  }
  const double margin = 0.05 * (high - low);
  if (low < 0.0) low -= margin;
  const double per_pixel =
      std::max((high + margin - low) / box.width(), 1.15 * radius / box.height());
  Panel panel;
  panel.box = box;
  panel.x = {low, low + per_pixel * box.width(), "normal stress (MPa)"};
  panel.y = {0.0, per_pixel * box.height(), "shear stress (MPa)"};
  panel.has_grid = true;
  return panel;
}

std::vector<Pixel> half_circle(const Panel& panel, const dem::MohrCircle& m)
{
  std::vector<Pixel> points;
  constexpr int n = 90;
  for (int k = 0; k <= n; ++k) {
    const double angle = dem::pi * k / n;
    points.push_back(panel.at((m.centre() - m.radius() * std::cos(angle)) / MPa,
                              m.radius() * std::sin(angle) / MPa));
  }
  return points;
}

/// Within the panel.
std::vector<Pixel> coulomb(const Panel& panel, const dem::CoulombLine& line)
{
  const double c = line.c / MPa, slope = std::tan(line.phi);
  double from = panel.x.from, to = panel.x.to;
  const double at_foot = -c / slope, at_head = (panel.y.to - c) / slope; // inf if level
  if (slope > 0.0) {
    from = std::max(from, at_foot);
    to = std::min(to, at_head);
  } else if (slope < 0.0) {
    from = std::max(from, at_head);
    to = std::min(to, at_foot);
  }
  return {panel.at(from, c + slope * from), panel.at(to, c + slope * to)};
}

std::vector<KeyEntry> key(const TestSeries& series)
{
  std::vector<KeyEntry> entries;
  const auto names = group_names(series);
  for (std::size_t g = 0; g < names.size(); ++g) {
    const auto& members = series.groups.members[g];
    const auto is_drawn = [&](const StrengthFit& fit) {
      return fit.line && std::any_of(members.begin(), members.end(), [&](std::size_t k) {
               return std::find(fit.of.tests.begin(), fit.of.tests.end(), k) !=
                      fit.of.tests.end();
             });
    };
    if (is_drawn(series.peak) || is_drawn(series.critical))
      entries.push_back({names[g], distinct_stroke(g)});
  }
  entries.push_back({"Coulomb line", {ink, 4.0, {}}});
  return entries;
}

} // namespace

std::size_t n_mohr_panels(const TestSeries& series)
{
  return (series.peak.line ? 1u : 0u) + (series.critical.line ? 1u : 0u);
}

void draw_mohr(Page& page, const TestSeries& series)
{
  const auto entries = key(series);
  const Layout places = captioned_panels(page, n_mohr_panels(series), 1, entries);
  const auto groups = group_of_each(series);
  std::size_t place = 0;
  const auto draw = [&](const StrengthFit& fit, const std::string& where) {
    if (!fit.line) return;
    const Panel panel = panel_of(places.boxes[place++], fit);
    draw_axes(page, panel);
    for (std::size_t k = 0; k < fit.circles.size(); ++k) {
      Stroke stroke = distinct_stroke(groups[fit.of.tests[k]]);
      stroke.width = 3.5;
      page.line(half_circle(panel, fit.circles[k]), stroke);
    }
    page.line(coulomb(panel, *fit.line), {ink, 4.0, {}});
    char R2[40] = "";
    if (fit.R2()) std::snprintf(R2, sizeof R2, ", R2 = %.4f", *fit.R2());
    write_caption(page, panel.box,
                  where + ": " + in_words(*fit.line) + R2 + ", " +
                      std::to_string(fit.circles.size()) + " tests");
  };
  draw(series.peak, "peak");
  draw(series.critical, "critical state");
  draw_key(page, places.key, entries);
}

} // namespace mergel::apps
