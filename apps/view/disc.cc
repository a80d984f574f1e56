#include "apps/view/brazilian.h"
#include "apps/view/particles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <vtkDataArray.h>
#include <vtkPointData.h>

namespace mergel::apps {

namespace {

constexpr double thickness_of_plates = 0.05; // over the distance between them
constexpr std::array<const char*, 4> mode_names{"tension", "compression", "shear",
                                                "bending"};
constexpr std::array<Colour, 4> mode_colours{
    {{0.72, 0.17, 0.16}, {0.16, 0.39, 0.62}, {0.13, 0.13, 0.13}, {0.90, 0.60, 0.10}}};

/// "diametral strain 0.62 %   2P/(pi D t) 2.31 MPa   62 bonds broken", as in the history.
std::string caption(const dem::Table& history, double time)
{
  const std::vector<double>& t = history.column("time", "s");
  const auto at = [&](const char* name, const char* unit) {
    return dem::interpolate(t, history.column(name, unit), time);
  };
  char text[160];
  std::snprintf(text, sizeof text,
                "diametral strain %.3g %%     2P/(pi D t) %.3g MPa     time %.4g ms"
                "     %.0f bonds broken",
                100.0 * at("diametral strain", "-"), 1e-6 * at("2P/(pi D t)", "Pa"),
                1e3 * time, at("broken bonds", "-"));
  return text;
}

/// Number of breaks of each mode that are drawn.
using Modes = std::array<std::size_t, mode_names.size()>;

/// The traces of all breaks; a bond along y has none, and is a dot.
Modes draw_breaks(Page& page, const Panel& panel, vtkPolyData* breaks)
{
  Modes modes{};
  vtkPointData* data = breaks->GetPointData();
  vtkDataArray *normal = data->GetArray("normal"), *radius = data->GetArray("radius"),
               *mode = data->GetArray("mode");
  for (vtkIdType k = 0; k < breaks->GetNumberOfPoints(); ++k) {
    const double* x = breaks->GetPoint(k);
    const double* n = normal->GetTuple3(k);
    const auto m = static_cast<std::size_t>(
        std::clamp(mode->GetTuple1(k), 0.0, mode_names.size() - 1.0));
    ++modes[m];
    const double across = std::hypot(n[0], n[2]);
    if (across < 0.1) {
      page.dot(panel.at(x[0], x[2]), mode_colours[m], 6.0);
      continue;
    }
    const double r = radius->GetTuple1(k), dx = r * n[2] / across, dz = -r * n[0] / across;
    page.line({panel.at(x[0] - dx, x[2] - dz), panel.at(x[0] + dx, x[2] + dz)},
              mode_colours[m], 3.0);
  }
  return modes;
}

void draw_rim(Page& page, const Panel& panel, double radius)
{
  constexpr int n = 180;
  std::vector<Pixel> rim;
  for (int k = 0; k <= n; ++k) {
    const double a = 2.0 * M_PI * k / n;
    rim.push_back(panel.at(radius * std::cos(a), radius * std::sin(a)));
  }
  page.line(rim, ink, 2.0);
}

void draw_plates(Page& page, const Panel& panel, const Bounds& plates, double thickness)
{
  const double left = std::max(plates[0], panel.x.from),
               right = std::min(plates[1], panel.x.to);
  const auto plate = [&](double from, double to) {
    page.fill({panel.at(left, from), panel.at(right, from), panel.at(right, to),
               panel.at(left, to)},
              steel);
  };
  plate(plates[4] - thickness, plates[4]);
  plate(plates[5], plates[5] + thickness);
}

/// Mode and number of the breaks, below each other.
void draw_modes(Page& page, const Pixel& head, const Modes& modes)
{
  const double u = page.unit();
  double y = head.y;
  page.text({head.x, y}, "broken in", {1.0, Across::left, Up::foot});
  for (std::size_t m = 0; m < modes.size(); ++m) {
    y -= 42.0 * u;
    page.line({{head.x, y}, {head.x + 40.0 * u, y}}, mode_colours[m], 4.0);
    page.text({head.x + 54.0 * u, y},
              std::string(mode_names[m]) + "  " + std::to_string(modes[m]),
              {0.9, Across::left});
  }
}

} // namespace

void draw_disc(Page& page, const DiscFrame& frame, const dem::Table& history)
{
  const AssemblyPicture picture = damage_picture();
  const auto table = lookup_table(picture);
  const double u = page.unit();
  const Bounds plates = bounds(frame.plates);
  const double gap = plates[5] - plates[4], thickness = thickness_of_plates * gap;

  const double left = 130.0 * u, between = 60.0 * u, right = 30.0 * u;
  const double top = page.height() - 90.0 * u, bottom = 430.0 * u; // legends below
  // A split disc is wider than its plates; fragments that fly off are left out.
  const Window window{0.0, 0.5 * (plates[4] + plates[5]), 1.25 * (plates[1] - plates[0]),
                      gap + 3.0 * thickness};
  const double room = 0.5 * (page.width() - right - left - between);
  const double px_per_mm = std::min((top - bottom) / window.height, room / window.width);
  const double width = window.width * px_per_mm, z_from = top - window.height * px_per_mm;

  const auto panel_at = [&](double x, const std::string& z_title) {
    Panel panel;
    panel.box = {x, z_from, x + width, top};
    panel.x = {window.left(), window.right(), "x (mm)"};
    panel.y = {window.bottom(), window.top(), z_title};
    return panel;
  };
  const Panel face = panel_at(left, "z (mm)"),
              cracks = panel_at(left + width + between, "");
  vtkRenderer* scene = page.scene(face.box);
  scene->AddActor(spheres(drawn(frame.particles, picture.array, Cut::whole), table));
  look_along_y(scene, window);
  Modes modes{};
  draw_rim(page, cracks, 0.5 * (plates[1] - plates[0]));
  if (frame.breaks) modes = draw_breaks(page, cracks, frame.breaks);
  for (const Panel* panel : {&face, &cracks}) {
    draw_plates(page, *panel, plates, thickness);
    draw_axes(page, *panel);
  }
  const double foot = z_from - 370.0 * u;
  draw_legend(page, {left, foot, left + 40.0 * u, foot + 170.0 * u}, picture, table);
  draw_modes(page, {cracks.box.left, foot + 192.0 * u}, modes);
  page.text({left, top + 25.0 * u}, caption(history, frame.time),
            {1.1, Across::left, Up::foot});
}

} // namespace mergel::apps
