#include "apps/view/laboratory/critical_state.h"

#include "apps/view/laboratory/layout.h"
#include "apps/view/plot.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

namespace {

constexpr double MPa = 1e6;
const Stroke fitted{ink, 4.0, {}};

double abscissa(double p)
{
  return std::pow(std::max(0.0, p) / dem::atmosphere, dem::critical_exponent);
}

} // namespace

void draw_critical_states(Page& page, const TestSeries& series)
{
  const CriticalFit& fit = series.critical_states;
  const auto groups = group_of_each(series);
  const auto names = group_names(series);
  Plot volume, stress;
  volume.x = {"(p/p_a)^0.7", Reach::from_zero};
  volume.y = {"void ratio e", Reach::of_values};
  stress.x = {"p (MPa)", Reach::from_zero};
  stress.y = {"q (MPa)", Reach::from_zero};
  Scatter in_volume, in_stress;
  in_volume.mark = in_stress.mark = Mark::disc;

  std::vector<KeyEntry> entries;
  double p_most = 0.0;
  std::vector<bool> is_named(names.size(), false);
  for (const std::size_t k : fit.of.tests) {
    const TestReading& test = series.tests[k];
    Stroke stroke = distinct_stroke(groups[k]);
    stroke.width = 2.5;
    if (!is_named[groups[k]]) entries.push_back({names[groups[k]], stroke});
    is_named[groups[k]] = true;
    PlotCurve e_path, q_path;
    e_path.stroke = q_path.stroke = stroke;
    for (const StressState& s : test.curve) {
      e_path.x.push_back(abscissa(s.p));
      e_path.y.push_back(s.e);
      q_path.x.push_back(s.p / MPa);
      q_path.y.push_back(s.q / MPa);
    }
    volume.curves.push_back(std::move(e_path));
    stress.curves.push_back(std::move(q_path));
    in_volume.x.push_back(abscissa(test.end.p));
    in_volume.y.push_back(test.end.e);
    in_stress.x.push_back(test.end.p / MPa);
    in_stress.y.push_back(test.end.q / MPa);
    p_most = std::max(p_most, test.end.p);
  }
  const double x_most = abscissa(p_most);
  volume.curves.push_back(
      {{0.0, x_most},
       {fit.line->intercept, fit.line->intercept + fit.line->slope * x_most},
       fitted});
  stress.curves.push_back(
      {{0.0, p_most / MPa}, {0.0, fit.ratio->M * p_most / MPa}, fitted});
  volume.scatters.push_back(std::move(in_volume));
  stress.scatters.push_back(std::move(in_stress));
  entries.push_back({"critical state", {ink, 0.0, {}}, Mark::disc});
  entries.push_back({"least squares", fitted});

  const Layout places = captioned_panels(page, 2, 1, entries);
  draw_plot(page, places.boxes[0], volume);
  draw_plot(page, places.boxes[1], stress);
  write_caption(page, places.boxes[0], in_words(*fit.line));
  write_caption(page, places.boxes[1], in_words(*fit.ratio) + "; " + volume_in_words(fit));
  draw_key(page, places.key, entries);
}

} // namespace mergel::apps
