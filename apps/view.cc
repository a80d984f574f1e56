/// mergel-view: pictures of a pile run. Reads the folder that `mergel pile` wrote and
/// leaves damage.png, displacement.png and load.png in it.

#include "apps/history_table.h"
#include "apps/view_chart.h"
#include "apps/view_displacement.h"
#include "apps/view_results.h"
#include "apps/view_scene.h"
#include "dem/error.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

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
std::string caption(const HistoryTable& history, double time)
{
  const std::vector<double>& t = history.column("time", "s");
  const double depth = interpolate(t, history.column("depth/D_p", "-"), time);
  const double broken = interpolate(t, history.column("bonds broken", "-"), time);
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

void draw(const fs::path& folder, int number, const Size& size)
{
  const HistoryTable history = read_history(folder / "history.csv");
  if (history.is_last_line_cut)
    std::cerr
        << "mergel-view: " << history.file.string()
        << ": the last line is not complete (is the run still going?) and is left out.\n";
  ResultFrame frame = read_frame(folder, number);
  const auto save = [&](Page& page, const char* name) {
    page.save(folder / name);
    std::cout << (folder / name).string() << '\n';
  };
  const auto draw_picture = [&](RockPicture picture, const char* name) {
    picture.caption = caption(history, frame.time);
    Page page(size.width, size.height);
    draw_rock(page, frame, picture);
    save(page, name);
  };

  Page chart(size.width, size.height);
  draw_load(chart, history);
  save(chart, "load.png");

  draw_picture(damage_picture(), "damage.png");

  const double largest = add_displacement(read_frame(folder, 0), frame);
  if (largest > 0.0)
    draw_picture(displacement_picture(largest), "displacement.png");
  else
    std::cout << "no displacement.png: nothing has moved since frame 0\n";
}

} // namespace

int main(int argc, char** argv)
{
  std::string folder, size_text = "1600x1200";
  int number = -1;
  CLI::App app(
      "Draw a pile run: damage.png, load.png and displacement.png in its results folder.",
      "mergel-view");
  app.add_option("DIR", folder, "Results folder written by 'mergel pile'")->required();
  app.add_option("--frame", number,
                 "Frame to draw, from 0; negative: from the end (default: the last)");
  app.add_option("--size", size_text, "Size of the pictures in pixels")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1; // 0: --help was asked for
  }

  try {
    const Size size = parse_size(size_text);
    if (!has_display()) {
      std::cerr
          << "mergel-view: no display to draw with. Run 'xvfb-run -a mergel-view ...'.\n";
      return 2;
    }
    draw(folder, number, size);
    return 0;
  } catch (const InputError& error) {
    std::cerr << "mergel-view: " << error.what() << '\n';
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "mergel-view: " << error.what() << '\n';
    return 2;
  }
}
