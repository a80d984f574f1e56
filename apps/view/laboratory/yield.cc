#include "apps/view/laboratory/yield.h"

#include "apps/view/laboratory/layout.h"
#include "apps/view/plot.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

namespace {

constexpr double MPa = 1e6;
const Stroke path_stroke{{0.72, 0.72, 0.72}, 2.5, {}};

/// States of one kind.
struct MarkedStates {
  const char* words;
  Mark mark;
  std::vector<StressState> states;
};

std::vector<MarkedStates> marked_states(const TestSeries& series)
{
  MarkedStates yield{"yield under shear", Mark::disc, {}},
      peak{"peak of q", Mark::triangle, {}},
      isotropic{"isotropic yield", Mark::full_square, {}},
      other{"yield on another path", Mark::full_diamond, {}};
  for (const TestReading& t : series.tests) {
    if (t.yield && t.kind == TestKind::isotropic) // its q is noise
      isotropic.states.push_back({t.yield->strain, t.yield->p, 0.0, t.yield->e});
    else if (t.yield) {
      (t.is_sheared() ? yield : other).states.push_back(*t.yield);
    }
    if (t.peak && t.is_sheared()) peak.states.push_back(*t.peak);
  }
  std::vector<MarkedStates> all;
  for (const MarkedStates& kind : {yield, peak, isotropic, other})
    if (!kind.states.empty()) all.push_back(kind);
  return all;
}

/// The path of a test up to its yield and its peak.
PlotCurve path_of(const TestReading& t)
{
  double end = 0.0;
  for (const auto& state : {t.yield, t.peak})
    if (state) end = std::max(end, std::abs(state->strain));
  PlotCurve path;
  path.stroke = path_stroke;
  for (const StressState& s : t.curve) {
    if (std::abs(s.strain) > end || t.kind == TestKind::isotropic) break;
    path.x.push_back(s.p / MPa);
    path.y.push_back(s.q / MPa);
  }
  return path;
}

} // namespace

std::string lacks_of_yield(const TestSeries& series)
{
  std::size_t n = 0;
  for (const MarkedStates& kind : marked_states(series)) n += kind.states.size();
  return n < 2 ? "yield points and peaks of q: " + std::to_string(n) + "; two are needed"
               : "";
}

void draw_yield(Page& page, const TestSeries& series)
{
  Plot plot;
  plot.x = {"p (MPa)", Reach::from_zero};
  plot.y = {"q (MPa)", Reach::from_zero};
  std::vector<KeyEntry> entries;
  for (const TestReading& t : series.tests) plot.curves.push_back(path_of(t));
  double p_most = 0.0, q_most = 0.0;
  for (const MarkedStates& kind : marked_states(series)) {
    Scatter scatter;
    scatter.mark = kind.mark;
    for (const StressState& s : kind.states) {
      scatter.x.push_back(s.p / MPa);
      scatter.y.push_back(s.q / MPa);
      p_most = std::max(p_most, s.p / MPa);
      q_most = std::max(q_most, s.q / MPa);
    }
    plot.scatters.push_back(std::move(scatter));
    entries.push_back({kind.words, {ink, 0.0, {}}, kind.mark});
  }
  entries.push_back({"stress paths", path_stroke});
  // q = k + M p, drawn as far as its points reach
  const auto line = [&](double k, double M, double p_end, const std::string& words,
                        const Stroke& stroke) {
    const double to =
        M > 0.0 ? std::min(p_end, std::max(0.0, (1.1 * q_most - k) / M)) : p_end;
    plot.curves.push_back({{0.0, to}, {k, k + M * to}, stroke});
    entries.push_back({words, stroke});
  };
  if (series.peak.line) {
    const double sine = std::sin(series.peak.line->phi),
                 cosine = std::cos(series.peak.line->phi);
    double p_end = 0.0;
    for (const std::size_t k : series.peak.of.tests)
      p_end = std::max(p_end, series.tests[k].peak->p / MPa);
    line(6.0 * series.peak.line->c / MPa * cosine / (3.0 - sine), 6.0 * sine / (3.0 - sine),
         p_end, "Coulomb line at the peak", {{0.86, 0.37, 0.05}, 4.0, {24.0, 12.0}});
  }
  if (series.critical_states.ratio)
    line(0.0, series.critical_states.ratio->M, p_most, "critical state line",
         {{0.05, 0.28, 0.55}, 4.0, {}});

  const Layout places = captioned_panels(page, 1, 1, entries);
  draw_plot(page, places.boxes[0], plot);
  draw_key(page, places.key, entries);
}

} // namespace mergel::apps
