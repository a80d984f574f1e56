#include "apps/view/laboratory/draw_tests.h"

#include "apps/laboratory/test_reading.h"
#include "apps/view/brazilian.h"
#include "apps/view/element.h"
#include "apps/view/laboratory/mean_runs.h"
#include "apps/view/localisation.h"
#include "apps/view/output.h"
#include "apps/view/points.h"
#include "apps/view/results.h"
#include "apps/view/specimen.h"
#include "dem/error.h"
#include "dem/io/readable.h"

#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

/// Whether a table has a line below its headings.
bool has_record(const fs::path& table)
{
  std::ifstream in(table);
  int n = 0;
  for (std::string line; std::getline(in, line);) n += line.starts_with('#') ? 0 : 1;
  return n > 1;
}

/// localisation.png of one test, where the run has looked for bands at the time of the frame.
void draw_bands(const Options& options, const SpecimenFrame& frame)
{
  const fs::path file = fs::path(options.folders.front()) / "localisation.csv";
  if (!dem::is_readable(file)) {
    std::cout << "no localisation.png: the folder holds no localisation.csv\n";
    return;
  }
  dem::Table bands;
  if (has_record(file)) bands = dem::read_table(file);
  const auto row = bands.n_rows > 0 ? bands_at(frame.time, bands) : std::nullopt;
  if (!row) {
    std::cout << "no localisation.png: bands are looked for while the specimen is sheared, "
                 "and not at the time of this frame\n";
    return;
  }
  Page page(options.size.width, options.size.height);
  draw_localisation(page, frame, bands, *row);
  save(page, picture_folder(options) / "localisation.png");
}

} // namespace

void draw_panels(const Options& options, const std::vector<RunPlot>& plots,
                 const std::vector<Run>& runs, const char* name)
{
  std::vector<Points> points;
  for (const std::string& file : options.points)
    points.push_back(read_points(file, distinct_mark(points.size())));
  check_points(points, plots);
  const fs::path output = picture_folder(options);
  Page page(options.size.width, options.size.height);
  draw_runs(page, plots, runs, points);
  save(page, output / name);
}

void require_numbers_of_case(const fs::path& folder, const dem::Table& history)
{
  if (dem::is_readable(folder / "resolved.prm"))
    require_numbers_of_case(history, read_test_case(folder));
}

std::vector<Run> runs_of(const Options& options, const Stages& stages,
                         const std::vector<dem::Table>& histories)
{
  const std::vector<RunName> names = run_names(options);
  std::vector<Run> runs;
  for (std::size_t k = 0; k < histories.size(); ++k) {
    if (!stages.is_all()) require_numbers_of_case(options.folders[k], histories[k]);
    runs.push_back({names[k], from_stages(histories[k], stages)});
  }
  return runs;
}

void draw_stages(const Options& options, const Stages& stages,
                 const std::vector<dem::Table>& histories, const char* sheared)
{
  const std::vector<Run> runs = as_asked(options, runs_of(options, stages, histories));
  if (is_isotropic(runs))
    draw_panels(options, isotropic_plots(runs, stages), runs, "isotropic.png");
  else
    draw_panels(options, element_plots(runs, stages), runs, sheared);
}

void draw_triaxial(const Options& options, const Stages& stages,
                   const std::vector<dem::Table>& histories)
{
  const fs::path folder = options.folders.front();
  const bool is_one = histories.size() == 1;
  const bool has_pictures = is_one && dem::is_readable(folder / "particles.pvd");
  Options of_panels = options;
  of_panels.has_frame = options.has_frame && !has_pictures;
  SpecimenFrame frame;
  if (has_pictures)
    frame = read_specimen(folder, options.frame); // refused before any picture
  draw_stages(of_panels, stages, histories, "triaxial.png");
  if (has_pictures) {
    Page page(options.size.width, options.size.height);
    draw_specimen(page, frame, histories.front());
    save(page, picture_folder(options) / "specimen.png");
    draw_bands(options, frame);
  } else if (is_one) {
    std::cout << "no specimen.png: the folder holds no particles.pvd\n";
  }
}

void draw_brazilian(const Options& options, const std::vector<dem::Table>& histories)
{
  const fs::path folder = options.folders.front();
  const bool is_one = histories.size() == 1;
  const bool has_pictures = is_one && dem::is_readable(folder / "particles.pvd");
  Options of_panels = options;
  of_panels.has_frame = options.has_frame && !has_pictures;
  DiscFrame frame;
  if (has_pictures) frame = read_disc(folder, options.frame); // refused before any picture
  const std::vector<Run> runs = runs_of(of_panels, {}, histories);
  draw_panels(options, brazilian_plots(runs), runs, "brazilian.png");
  if (has_pictures) {
    Page page(options.size.width, options.size.height);
    draw_disc(page, frame, histories.front());
    save(page, picture_folder(options) / "disc.png");
  } else if (is_one) {
    std::cout << "no disc.png: the folder holds no particles.pvd\n";
  }
}

void draw_curves(const Options& options, const Stages& stages,
                 const std::vector<dem::Table>& histories)
{
  const std::vector<Run> runs = as_asked(options, runs_of(options, stages, histories));
  std::vector<RunPlot> plots;
  for (const std::string& text : options.curves) {
    auto [x, y] = curve_of(text);
    name_stages(x, stages);
    name_stages(y, stages);
    try {
      plots.push_back(plot_of(x, y, runs));
    } catch (const InputError& error) {
      throw InputError("--curve \"" + text + "\": " + error.what());
    }
  }
  draw_panels(options, plots, runs, "curve.png");
}

} // namespace mergel::apps
