/// mergel-view: pictures of runs. Of a pile run: damage.png, displacement.png and load.png;
/// of bond runs: loads.png and surface.png.

#include "apps/view_bond.h"
#include "apps/view_bond_loads.h"
#include "apps/view_bond_surface.h"
#include "apps/view_chart.h"
#include "apps/view_displacement.h"
#include "apps/view_results.h"
#include "apps/view_scene.h"
#include "dem/error.h"
#include "dem/io/table.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
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

/// VTK aborts without a message of ours when it finds no display.
bool has_display()
{
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return false;
  XCloseDisplay(display);
  return true;
}

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

RockPicture damage_picture()
{
  RockPicture picture;
  picture.array = "damage";
  picture.colours = damage_colours();
  picture.legend = "damage of\nthe bonds";
  return picture;
}

/// Three decades below the power of ten above `largest` [mm]: beside a pile the rock moves
/// by its radius, the far field by a thousandth of it.
RockPicture displacement_picture(double largest)
{
  RockPicture picture;
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
        << ": the last line is not complete (is the run still going?) and is left out.\n";
  return history;
}

/// Where the pictures go; made if it is not there.
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

void save(Page& page, const fs::path& png)
{
  page.save(png);
  std::cout << png.string() << '\n';
}

void draw_pile(const Options& options, const dem::Table& history)
{
  const fs::path folder = options.folders.front();
  if (!options.labels.empty())
    throw InputError("--label " + options.labels.front() + ": is for bond runs; " +
                     folder.string() + " holds a pile run. Leave it out.");
  ResultFrame frame = read_frame(folder, options.frame);
  const fs::path output = picture_folder(options);
  const auto draw_picture = [&](RockPicture picture, const char* name) {
    picture.caption = caption(history, frame.time);
    Page page(options.size.width, options.size.height);
    draw_rock(page, frame, picture);
    save(page, output / name);
  };

  Page chart(options.size.width, options.size.height);
  draw_load(chart, history);
  save(chart, output / "load.png");

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

void draw_bonds(const Options& options, const std::vector<dem::Table>& histories)
{
  const auto& folders = options.folders;
  require(!options.has_frame,
          "--frame " + std::to_string(options.frame) +
              ": is for pile runs; a bond run has no frames. Leave it out.");
  require(options.labels.empty() || options.labels.size() == folders.size(),
          "--label: given " + std::to_string(options.labels.size()) + " times for " +
              std::to_string(folders.size()) +
              " folder(s): must be given once for each, in their order, or not at all.");
  require(folders.size() == 1 || !options.output.empty(),
          "--output: must be given with several folders, to say where their common "
          "pictures go.");
  const auto labels = options.labels.empty() ? folder_labels(folders) : options.labels;
  std::vector<BondRun> runs, with_surface;
  for (std::size_t k = 0; k < folders.size(); ++k)
    runs.push_back(read_bond_run(folders[k], histories[k], {k, labels[k]}));
  const fs::path output = picture_folder(options);

  Page loads(options.size.width, options.size.height);
  draw_bond_loads(loads, runs);
  save(loads, output / "loads.png");

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
  save(surface, output / "surface.png");
}

void draw(const Options& options)
{
  std::vector<dem::Table> histories;
  for (const std::string& folder : options.folders) histories.push_back(history_of(folder));
  const bool is_bond = is_bond_history(histories.front());
  for (std::size_t k = 1; k < histories.size(); ++k)
    require(is_bond == is_bond_history(histories[k]),
            options.folders[is_bond ? k : 0] + " holds a pile run and " +
                options.folders[is_bond ? 0 : k] +
                " a bond run: they have no picture in common. Draw them one by one.");
  if (is_bond) {
    draw_bonds(options, histories);
    return;
  }
  require(histories.size() == 1, std::to_string(histories.size()) +
                                     " folders of pile runs: only bond runs are drawn "
                                     "together. Draw them one by one.");
  draw_pile(options, histories.front());
}

} // namespace

int main(int argc, char** argv)
{
  Options options;
  std::string size_text = "1600x1200";
  CLI::App app(
      "Draw runs. A pile run: damage.png, displacement.png and load.png. Bond runs, "
      "one or several on each other: loads.png and surface.png.",
      "mergel-view");
  app.add_option("DIR", options.folders,
                 "Results folder written by 'mergel pile' or 'mergel bond'; several only "
                 "of 'mergel bond'")
      ->required();
  app.add_option("--output", options.output,
                 "Folder for the pictures (default: DIR; required with several)");
  app.add_option(
         "--label", options.labels,
         "Name of a bond run in the key, once for each DIR in their order (default: "
         "the names of the folders)")
      ->allow_extra_args(false);
  const auto* frame = app.add_option(
      "--frame", options.frame,
      "Frame of a pile run to draw, from 0; negative: from the end (default: "
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
    if (!has_display()) {
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
