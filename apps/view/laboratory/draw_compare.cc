#include "apps/view/laboratory/draw_compare.h"

#include "apps/laboratory/test_reading.h"
#include "apps/view/laboratory/draw_tests.h"
#include "apps/view/laboratory/mean_runs.h"
#include "apps/view/laboratory/measured.h"
#include "apps/view/output.h"
#include "dem/error.h"

#include <algorithm>
#include <iostream>
#include <utility>

namespace mergel::apps {

namespace {

constexpr std::size_t most_marks = 25; // of one curve
constexpr int one_row = 850;           // height of a page with one row of panels

/// From the stage that is read on: a laboratory's strains count from the start of shearing.
Stages stage_read(const std::string& folder, std::vector<std::string>& notes)
{
  try {
    const TestReading test = read_test(folder, folder);
    if (test.stage < 2) return {};
    notes.push_back(folder + ": strains from stage " + std::to_string(test.stage) +
                    " on, " + name_of(test.kind) + "; --stage chooses another");
    return {static_cast<int>(test.stage), 0};
  } catch (const InputError&) { // nothing that tells stages
    return {};
  }
}

std::vector<Run> runs_from_their_stages(const Options& options,
                                        const std::vector<dem::Table>& histories,
                                        std::vector<std::string>& notes)
{
  if (!options.stage.empty()) return runs_of(options, stages_of(options.stage), histories);
  std::vector<Run> runs = runs_of(options, {}, histories);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!is_element_history(histories[k]) && !is_triaxial_history(histories[k])) continue;
    require_numbers_of_case(options.folders[k], histories[k]);
    runs[k].history = from_stages(histories[k], stage_read(options.folders[k], notes));
  }
  return runs;
}

/// Marks on a curve, not more than can be told apart.
Scatter marks_on(const PlotCurve& curve, Mark mark)
{
  Scatter scatter;
  scatter.mark = mark;
  const std::size_t step = 1 + (curve.x.size() - 1) / most_marks;
  for (std::size_t k = 0; k < curve.x.size(); k += step) {
    scatter.x.push_back(curve.x[k]);
    scatter.y.push_back(curve.y[k]);
  }
  return scatter;
}

} // namespace

void draw_compare(const Options& options, const std::vector<dem::Table>& histories)
{
  std::vector<Measured> measured;
  for (const std::string& file : options.compare) measured.push_back(read_measured(file));
  std::vector<std::string> notes;
  const std::vector<Run> runs =
      as_asked(options, runs_from_their_stages(options, histories, notes));
  const std::vector<RunPlot> panels = panels_of(measured, runs);

  std::vector<KeyEntry> entries;
  for (const Run& run : runs)
    entries.push_back({run.name.label, distinct_stroke(run.name.number)});
  const Stroke thin{ink, 2.5, {}};
  for (std::size_t k = 0; k < measured.size(); ++k)
    entries.push_back({measured[k].label, thin, distinct_mark(k)});

  const auto output = picture_folder(options);
  for (const Measured& m : measured)
    for (const std::string& line : gaps_in(m)) notes.push_back(line);
  for (const std::string& note : notes) std::cout << note << '\n';
  const bool is_one_row = panels.size() < 3 && !options.has_size;
  Page page(options.size.width, is_one_row ? one_row : options.size.height);
  const Grid places = grid(page, panels.size(), entries);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    Plot plot = plot_of_runs(panels[k], runs);
    for (std::size_t f = 0; f < measured.size(); ++f) {
      PlotCurve curve = curve_in(panels[k], measured[f], runs);
      if (curve.x.empty()) continue;
      curve.stroke = thin;
      plot.scatters.push_back(marks_on(curve, distinct_mark(f)));
      plot.curves.push_back(std::move(curve));
    }
    draw_plot(page, places.boxes[k], plot);
  }
  draw_key(page, places.key, entries);
  save(page, output / "compare.png");
}

} // namespace mergel::apps
