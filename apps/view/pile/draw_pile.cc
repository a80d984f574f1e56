#include "apps/view/pile/draw_pile.h"

#include "apps/view/output.h"
#include "apps/view/pile/chart.h"
#include "apps/view/pile/displacement.h"
#include "apps/view/pile/draw_fields.h"
#include "apps/view/pile/draw_profiles.h"
#include "apps/view/pile/scene.h"
#include "apps/view/pile/section_image.h"
#include "apps/view/results.h"
#include "dem/error.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

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

} // namespace

void draw_pile_load(const Options& options, const dem::Table& history)
{
  std::vector<Measured> measured;
  for (const std::string& file : options.compare) measured.push_back(read_measured(file));
  const fs::path output = picture_folder(options);
  Page chart(options.size.width, options.size.height);
  draw_load(chart, history, measured);
  save(chart, output / "load.png");
}

void draw_pile(const Options& options, const dem::Table& history)
{
  const fs::path folder = options.folders.front();
  if (!options.labels.empty())
    throw InputError(
        "--label " + options.labels.front() +
        ": is for bond, element, triaxial and Brazilian runs, and for --curve; " +
        folder.string() + " holds a pile run. Leave it out.");
  ResultFrame frame = read_frame(folder, options.frame);
  const fs::path output = picture_folder(options);
  const auto draw_picture = [&](AssemblyPicture picture, const char* name) {
    picture.caption = caption(history, frame.time);
    Page page(options.size.width, options.size.height);
    draw_assembly(page, frame, picture);
    save(page, output / name);
  };

  draw_pile_load(options, history);

  draw_picture(damage_picture(), "damage.png");

  const ResultFrame start = read_frame(folder, 0);
  const ContinuumFrame continuum = read_continuum(folder, frame.time);
  if (continuum.section) {
    const SectionValues porosity(read_continuum(folder, start.time).section, "porosity [-]",
                                 1, component(0));
    const double most = 2.0 * porosity.h() * (porosity.n_x() + porosity.n_z());
    draw_fields(options, output, frame, continuum,
                porosity.quantile(0.5, {0.0, 0.0, most, most}),
                caption(history, frame.time));
    draw_profiles(options, output, frame.time, caption(history, frame.time));
  } else {
    std::cout << "no pictures of fields: the run has no fields.pvd\n";
  }

  const double largest = add_displacement(start, frame);
  if (largest > 0.0)
    draw_picture(displacement_picture(largest), "displacement.png");
  else
    std::cout << "no displacement.png: nothing has moved since frame 0\n";
}

} // namespace mergel::apps
