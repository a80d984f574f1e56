/// mergel-view: pictures of runs. Of a pile run: damage.png, displacement.png and load.png;
/// of bond runs: loads.png and surface.png; of element runs: element.png or isotropic.png;
/// of triaxial runs: triaxial.png or isotropic.png, and of one specimen.png and
/// localisation.png; of any: curve.png.

#include "apps/view/bond.h"
#include "apps/view/bond_loads.h"
#include "apps/view/bond_surface.h"
#include "apps/view/chart.h"
#include "apps/view/displacement.h"
#include "apps/view/element.h"
#include "apps/view/localisation.h"
#include "apps/view/points.h"
#include "apps/view/results.h"
#include "apps/view/run_plot.h"
#include "apps/view/scene.h"
#include "apps/view/specimen.h"
#include "dem/error.h"
#include "dem/io/table.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <X11/Xlib.h>

using namespace mergel;
using namespace mergel::apps;
namespace fs = std::filesystem;

namespace {

struct Size {
  int width = 1600, height = 1200;
};

Size parse_size(const std::string& text)
{
  Size size;
  char rest = 0;
  const bool is_read =
      std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) == 2;
  const auto fits = [](int n) { return 200 <= n && n <= 8000; };
  require(is_read && fits(size.width) && fits(size.height),
          "--size " + text +
              ": must be WIDTHxHEIGHT with 200 to 8000 pixels each, such as 1600x1200.");
  return size;
}

/// Checks for a display, because VTK aborts without one and without a message of ours. The
/// connection stays open, because Xvfb restarts when its last client leaves and then
/// refuses VTK.
class DisplayConnection {
public:
  DisplayConnection() = default;
  DisplayConnection(const DisplayConnection&) = delete;
  DisplayConnection& operator=(const DisplayConnection&) = delete;
  ~DisplayConnection()
  {
    if (display_ != nullptr) XCloseDisplay(display_);
  }
  bool is_open() const { return display_ != nullptr; }

private:
  Display* display_ = XOpenDisplay(nullptr);
};

/// "depth 3.00 D_p, time 4.36 ms, 6208 bonds broken"; depth as in the history at that time.
std::string caption(const dem::Table& history, double time)
{
  const std::vector<double>& t = history.column("time", "s");
  const double depth = dem::interpolate(t, history.column("depth/D_p", "-"), time);
  const double broken = dem::interpolate(t, history.column("bonds broken", "-"), time);
  char text[160];
  std::snprintf(text, sizeof text,
                "depth %.2f pile diameters     time %.4g ms     %.0f bonds broken", depth,
                1e3 * time, broken);
  return text;
}

/// Three decades below the power of ten above `largest` [mm]: beside a pile the particles
/// move by its radius, the far field by a thousandth of it.
AssemblyPicture displacement_picture(double largest)
{
  AssemblyPicture picture;
  picture.array = displacement_array;
  picture.high = std::pow(10.0, std::ceil(std::log10(largest)));
  picture.low = 1e-3 * picture.high;
  picture.is_logarithmic = true;
  picture.is_far_field_coloured = true;
  picture.colours = displacement_colours();
  picture.legend = "displacement\n(mm)";
  return picture;
}

/// What the command line asks for.
struct Options {
  std::vector<std::string> folders; ///< of the runs
  std::vector<std::string> labels;  ///< of the folders, in their order; empty: their names
  fs::path output;                  ///< of the pictures; empty: the only folder
  std::vector<std::string> curves;  ///< "X:Y" of each panel of curve.png; empty: none
  std::vector<std::string> points;  ///< files that are laid over the curves
  std::string stage;                ///< of element runs; empty: all
  int frame = -1;
  bool has_frame = false, has_size = false;
  Size size;
};

dem::Table history_of(const fs::path& folder)
{
  require(fs::is_directory(folder), folder.string() + ": is no folder.");
  dem::Table history = dem::read_table(folder / "history.csv");
  if (history.is_last_line_cut)
    std::cerr
        << "mergel-view: " << history.file.string()
        << ": the last line is not complete (is the run still active?) and is left out.\n";
  return history;
}

/// The folder of the pictures; made if it does not exist.
fs::path picture_folder(const Options& options)
{
  if (options.output.empty()) return options.folders.front();
  std::error_code error;
  fs::create_directories(options.output, error);
  require(fs::is_directory(options.output),
          "--output " + options.output.string() + ": cannot be made a folder" +
              (error ? " (" + error.message() + ")" : "") + ". Choose another.");
  return options.output;
}

/// A picture replaces an earlier one, and in the folder of its run what has its name there.
/// @throws InputError when it would replace another file
void save(const Options& options, Page& page, const fs::path& png)
{
  std::error_code error;
  require(options.output.empty() || !fs::exists(fs::symlink_status(png, error)) ||
              is_picture_of_view(png),
          png.string() +
              ": exists, and this version of mergel-view has not made it. Move it "
              "away, or choose another folder with --output.");
  page.save(png);
  std::cout << png.string() << '\n';
}

void draw_pile(const Options& options, const dem::Table& history)
{
  const fs::path folder = options.folders.front();
  if (!options.labels.empty())
    throw InputError("--label " + options.labels.front() +
                     ": is for bond, element and triaxial runs, and for --curve; " +
                     folder.string() + " holds a pile run. Leave it out.");
  ResultFrame frame = read_frame(folder, options.frame);
  const fs::path output = picture_folder(options);
  const auto draw_picture = [&](AssemblyPicture picture, const char* name) {
    picture.caption = caption(history, frame.time);
    Page page(options.size.width, options.size.height);
    draw_assembly(page, frame, picture);
    save(options, page, output / name);
  };

  Page chart(options.size.width, options.size.height);
  draw_load(chart, history);
  save(options, chart, output / "load.png");

  draw_picture(damage_picture(), "damage.png");

  const double largest = add_displacement(read_frame(folder, 0), frame);
  if (largest > 0.0)
    draw_picture(displacement_picture(largest), "displacement.png");
  else
    std::cout << "no displacement.png: nothing has moved since frame 0\n";
}

/// The name of each folder; its path where two folders have one name.
std::vector<std::string> folder_labels(const std::vector<std::string>& folders)
{
  std::vector<std::string> names;
  for (const std::string& folder : folders)
    names.push_back(fs::canonical(folder).filename().string());
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  const bool is_unique = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  return is_unique ? names : folders;
}

/// The names of runs that are drawn over each other.
std::vector<RunName> run_names(const Options& options)
{
  const auto& folders = options.folders;
  require(
      !options.has_frame,
      "--frame " + std::to_string(options.frame) +
          ": is for damage.png and displacement.png of a pile run and for specimen.png "
          "and localisation.png of one triaxial run; curves have no frames. Leave it out.");
  require(options.labels.empty() || options.labels.size() == folders.size(),
          "--label: given " + std::to_string(options.labels.size()) + " times for " +
              std::to_string(folders.size()) +
              " folder(s): must be given once for each, in their order, or not at all.");
  require(folders.size() == 1 || !options.output.empty(),
          "--output: must be given with several folders, to say where their common "
          "pictures go.");
  const auto labels = options.labels.empty() ? folder_labels(folders) : options.labels;
  std::vector<RunName> names;
  for (std::size_t k = 0; k < folders.size(); ++k) names.push_back({k, labels[k]});
  return names;
}

void draw_bonds(const Options& options, const std::vector<dem::Table>& histories)
{
  const std::vector<RunName> names = run_names(options);
  std::vector<BondRun> runs, with_surface;
  for (std::size_t k = 0; k < histories.size(); ++k)
    runs.push_back(read_bond_run(options.folders[k], histories[k], names[k]));
  const fs::path output = picture_folder(options);

  Page loads(options.size.width, options.size.height);
  draw_bond_loads(loads, runs);
  save(options, loads, output / "loads.png");

  std::copy_if(runs.begin(), runs.end(), std::back_inserter(with_surface),
               [](const BondRun& run) { return run.has_surface; });
  if (with_surface.empty()) {
    std::cout << "no surface.png: only the damage bond has a yield surface to draw\n";
    return;
  }
  // two panels in a row, 600 pixels for each row unless --size says otherwise
  const int n_rows = (static_cast<int>(n_surface_panels(with_surface)) + 1) / 2;
  const int height =
      options.has_size ? options.size.height : std::max(options.size.height, 600 * n_rows);
  Page surface(options.size.width, height);
  draw_bond_surface(surface, with_surface);
  save(options, surface, output / "surface.png");
}

/// Draws runs over each other in these panels.
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
  save(options, page, output / name);
}

std::vector<Run> runs_of(const Options& options, const Stages& stages,
                         const std::vector<dem::Table>& histories)
{
  const std::vector<RunName> names = run_names(options);
  std::vector<Run> runs;
  for (std::size_t k = 0; k < histories.size(); ++k)
    runs.push_back({names[k], from_stages(histories[k], stages)});
  return runs;
}

/// @param sheared name of the picture where q matters
void draw_stages(const Options& options, const Stages& stages,
                 const std::vector<dem::Table>& histories, const char* sheared)
{
  const std::vector<Run> runs = runs_of(options, stages, histories);
  if (is_isotropic(runs))
    draw_panels(options, isotropic_plots(runs, stages), runs, "isotropic.png");
  else
    draw_panels(options, element_plots(runs, stages), runs, sheared);
}

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
  if (!fs::exists(file)) {
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
  save(options, page, picture_folder(options) / "localisation.png");
}

/// The panels, and of one test the specimen at a time of its pictures.
void draw_triaxial(const Options& options, const Stages& stages,
                   const std::vector<dem::Table>& histories)
{
  const fs::path folder = options.folders.front();
  const bool is_one = histories.size() == 1;
  const bool has_pictures = is_one && fs::exists(folder / "particles.pvd");
  Options of_panels = options;
  of_panels.has_frame = options.has_frame && !has_pictures;
  SpecimenFrame frame;
  if (has_pictures)
    frame = read_specimen(folder, options.frame); // refused before any picture
  draw_stages(of_panels, stages, histories, "triaxial.png");
  if (has_pictures) {
    Page page(options.size.width, options.size.height);
    draw_specimen(page, frame, histories.front());
    save(options, page, picture_folder(options) / "specimen.png");
    draw_bands(options, frame);
  } else if (is_one) {
    std::cout << "no specimen.png: the folder holds no particles.pvd\n";
  }
}

void draw_curves(const Options& options, const Stages& stages,
                 const std::vector<dem::Table>& histories)
{
  const std::vector<Run> runs = runs_of(options, stages, histories);
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

enum class Job { pile, bond, element, triaxial };

Job job_of(const dem::Table& history)
{
  if (is_bond_history(history)) return Job::bond;
  if (is_triaxial_history(history)) return Job::triaxial;
  return is_element_history(history) ? Job::element : Job::pile;
}

std::string described(Job job)
{
  switch (job) {
  case Job::pile:
    return "a pile run";
  case Job::bond:
    return "a bond run";
  case Job::triaxial:
    return "a triaxial run";
  case Job::element:
    break;
  }
  return "an element run";
}

void draw(const Options& options)
{
  std::vector<dem::Table> histories;
  for (const std::string& folder : options.folders) histories.push_back(history_of(folder));
  const auto& folders = options.folders;
  const Job job = job_of(histories.front());
  for (std::size_t k = 1; k < histories.size(); ++k) {
    const Job other = job_of(histories[k]);
    require(job == other, folders.front() + " holds " + described(job) + " and " +
                              folders[k] + " " + described(other) +
                              ": they have no picture in common. Draw them one by one.");
  }
  const bool has_stages = job == Job::element || job == Job::triaxial;
  const Stages stages = options.stage.empty() ? Stages{} : stages_of(options.stage);
  require(stages.is_all() || has_stages,
          "--stage " + options.stage + ": is for element and triaxial runs; " +
              folders.front() + " holds " + described(job) + ". Leave it out.");
  if (!options.curves.empty()) {
    draw_curves(options, stages, histories);
    return;
  }
  require(options.points.empty() || has_stages,
          "--points " + (options.points.empty() ? "" : options.points.front()) +
              ": is for element and triaxial runs and for --curve; " + folders.front() +
              " holds " + described(job) + ". Leave it out.");
  if (job == Job::element) {
    draw_stages(options, stages, histories, "element.png");
  } else if (job == Job::triaxial) {
    draw_triaxial(options, stages, histories);
  } else if (job == Job::bond) {
    draw_bonds(options, histories);
  } else {
    require(
        histories.size() == 1,
        std::to_string(histories.size()) +
            " folders of pile runs: only bond, element and triaxial runs, and the curves "
            "of --curve, are drawn together. Draw them one by one.");
    draw_pile(options, histories.front());
  }
}

} // namespace

int main(int argc, char** argv)
{
  std::signal(SIGPIPE, SIG_IGN); // all pictures are made, read or not what is printed
  Options options;
  std::string size_text = "1600x1200";
  CLI::App app(
      "Draw runs. A pile run: damage.png, displacement.png and load.png. Bond runs, "
      "one or several: loads.png and surface.png. Element runs, one or "
      "several: element.png (q and volumetric strain over axial strain, q and void ratio "
      "over p) or, where |q| stays below 1 % of p, isotropic.png (p over volumetric "
      "strain, void ratio over log p). Triaxial runs: the same as triaxial.png, with the "
      "volumetric strain of the middle third, and of one run "
      "specimen.png (particles through the membrane, and cut open) and localisation.png "
      "(shear strain across the slab in which it is localised). Any runs, with "
      "--curve: curve.png.",
      "mergel-view");
  app.add_option(
         "DIR", options.folders,
         "Results folder written by 'mergel pile', 'mergel bond', 'mergel element' or "
         "'mergel triaxial'; several of one job are drawn over each other (pile: with "
         "--curve)")
      ->required();
  app.add_option("--output", options.output,
                 "Folder for the pictures (default: DIR; required with several)");
  app.add_option(
         "--label", options.labels,
         "Name of a run in the key, once for each DIR in their order (default: the names "
         "of the folders)")
      ->allow_extra_args(false);
  app.add_option(
         "--curve", options.curves,
         "Draw curve.png instead: any column of history.csv over any other, \"X:Y\", such "
         "as \"axial strain:q\" or \"log p [kPa]:void ratio\"; A/B is the ratio of two "
         "columns (q/p), [unit] any that fits; repeat for more panels")
      ->allow_extra_args(false);
  app.add_option("--stage", options.stage,
                 "Of element and triaxial runs draw only from this stage on (2), or these "
                 "stages (2-3); "
                 "axial and volumetric strain then count from its start (of a stage that "
                 "resumes: from that "
                 "of the stage resumed)");
  app.add_option(
         "--points", options.points,
         "Points to lay over curves: a CSV file of two columns named as the axes of a "
         "panel, such as \"p [MPa],q [MPa]\", and above them, if wanted, \"# name in the "
         "key\"; repeatable")
      ->allow_extra_args(false);
  const auto* frame = app.add_option(
      "--frame", options.frame,
      "Frame of a pile or triaxial run to draw, from 0; negative: from the end (default: "
      "the last)");
  const auto* size =
      app.add_option(
             "--size", size_text,
             "Size of the pictures in pixels (surface.png of five panels: 1600x1800)")
          ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1; // 0: --help was asked for
  }

  try {
    options.has_frame = frame->count() > 0;
    options.has_size = size->count() > 0;
    options.size = parse_size(size_text);
    const DisplayConnection display;
    if (!display.is_open()) {
      std::cerr
          << "mergel-view: no display to draw with. Run 'xvfb-run -a mergel-view ...'.\n";
      return 2;
    }
    draw(options);
    return 0;
  } catch (const InputError& error) {
    std::cerr << "mergel-view: " << error.what() << '\n';
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "mergel-view: " << error.what() << '\n';
    return 2;
  }
}
