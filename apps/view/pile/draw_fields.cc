#include "apps/view/pile/draw_fields.h"

#include "apps/view/output.h"
#include "apps/view/pile/draw_chains.h"
#include "apps/view/pile/section_page.h"
#include "dem/error.h"
#include "dem/notation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>

namespace mergel::apps {

namespace {

constexpr double MPa = 1e-6; // [1/Pa]
constexpr double mm_per_m = 1e3;
constexpr double shown_share = 0.98; // of the values; the others have the last colour
constexpr int points_of_window = 3;  // along its edge: independent windows
const Colour compressed{0.05, 0.28, 0.55}, pulled{0.80, 0.13, 0.10};

/// Components xx, zz and xz of a stress tensor in a file.
constexpr int xx = 0, zz = 2, xz = 5;

AssemblyPicture picture_of(double low, double high, std::vector<Colour> colours,
                           const std::string& legend)
{
  AssemblyPicture picture;
  picture.low = low;
  picture.high = high;
  picture.colours = std::move(colours);
  picture.legend = legend;
  return picture;
}

/// White at 0, a fifth of the way up; blue in compression, red in tension.
std::vector<Colour> stress_colours()
{
  return {{0.75, 0.10, 0.10}, {0.97, 0.97, 0.95}, {0.66, 0.83, 0.88},
          {0.37, 0.62, 0.79}, {0.16, 0.36, 0.61}, {0.06, 0.12, 0.36}};
}

/// Brown where it is denser than at first, white, green where it is looser.
std::vector<Colour> porosity_colours()
{
  return {{0.35, 0.20, 0.05},
          {0.75, 0.55, 0.28},
          {0.97, 0.97, 0.95},
          {0.45, 0.72, 0.65},
          {0.00, 0.33, 0.28}};
}

SectionPanel panel_of(const std::string& title, const SectionValues& values,
                      const AssemblyPicture& picture, const Window& window)
{
  return {title, {face_of(values, lookup_table(picture), window)}, picture, window};
}

void draw_stress(Page& page, const ResultFrame& frame, vtkImageData* fields,
                 const std::string& caption)
{
  const std::string stress = "stress [Pa]";
  const auto pulled_by = [](const double* s) { return -MPa * std::min(s[0], 0.0); };
  const SectionValues vertical(fields, stress, 6, component(zz, -MPa)),
      radial(fields, stress, 6, component(xx, -MPa)),
      q(fields, "q [Pa]", 1, component(0, MPa)),
      tension(fields, "minor principal stress [Pa]", 1, pulled_by);
  const Window window = window_around(frame.pile, vertical);
  const auto compression = [&](const SectionValues& values, const char* name) {
    const double high = round_above(values.quantile(shown_share, window));
    return panel_of(std::string(name) + " (compression positive)", values,
                    picture_of(-0.25 * high, high, stress_colours(), "(MPa)"), window);
  };
  draw_sections(
      page, frame.pile,
      {compression(vertical, "vertical stress"), compression(radial, "radial stress"),
       panel_of("largest tension", tension,
                picture_of(0.0, round_above(tension.quantile(shown_share, window)),
                           damage_colours(), "(MPa)"),
                window),
       panel_of("deviatoric stress q", q,
                picture_of(0.0, round_above(q.quantile(shown_share, window)),
                           displacement_colours(), "(MPa)"),
                window)},
      caption);
}

/// @param at_start porosity before the penetration
void draw_porosity(Page& page, const ResultFrame& frame, vtkImageData* fields,
                   double at_start, const std::string& caption)
{
  const SectionValues porosity(fields, "porosity [-]", 1, component(0)),
      damage(fields, "damage [-]", 1, component(0));
  const Window window = window_around(frame.pile, porosity);
  const double middle = 0.05 * std::round(at_start / 0.05);
  const double away = std::max(middle - porosity.quantile(1.0 - shown_share, window),
                               porosity.quantile(shown_share, window) - middle);
  const double reach = std::clamp(0.1 * std::ceil(away / 0.1), 0.1, middle);
  AssemblyPicture of_damage = damage_picture();
  of_damage.legend = "(-)";
  char title[80];
  std::snprintf(title, sizeof title, "porosity (%.2f before the penetration)", at_start);
  draw_sections(
      page, frame.pile,
      {panel_of(title, porosity,
                picture_of(middle - reach, middle + reach, porosity_colours(), "(-)"),
                window),
       panel_of("mean damage of the bonds", damage, of_damage, window)},
      caption);
}

/// An arrow whose shaft is a bar, and two for its head.
void add_arrow(std::vector<Bar>& list, double x, double z, double u, double w, double width)
{
  const double head = 0.35;
  list.push_back({x, z, x + u, z + w, width, ink});
  for (const double side : {-1.0, 1.0})
    list.push_back({x + u, z + w, x + u - head * (u + side * 0.6 * w),
                    z + w - head * (w - side * 0.6 * u), width, ink});
}

void draw_layers(Page& page, const ResultFrame& frame, vtkImageData* fields,
                 const std::string& caption)
{
  const auto part = [&](int k) {
    return SectionValues(fields, "displacement increment [m]", 3, component(k, mm_per_m));
  };
  const SectionValues x = part(0), z = part(2),
                      size(fields, "displacement increment [m]", 3, [](const double*u) {
                        return mm_per_m * std::hypot(u[0], u[1], u[2]);
                      });
  const Window window = window_around(frame.pile, x);

  vtkDataArray* layer = frame.particles->GetPointData()->GetArray("layer [-]");
  require(layer != nullptr,
          "the particles have no array 'layer [-]'. Was the run made by this version of "
          "mergel?");
  constexpr int n_tones = 4;
  vtkNew<vtkDoubleArray> tone; // the colours of the layers follow each other
  tone->SetName("tone");
  for (vtkIdType p = 0; p < layer->GetNumberOfTuples(); ++p) {
    const auto index = static_cast<int>(layer->GetTuple1(p));
    tone->InsertNextValue(((index % n_tones) + n_tones) % n_tones);
  }
  frame.particles->GetPointData()->AddArray(tone);
  const AssemblyPicture tones = picture_of(
      0.0, n_tones - 1.0,
      {{0.93, 0.87, 0.72}, {0.72, 0.48, 0.30}, {0.55, 0.70, 0.78}, {0.20, 0.34, 0.46}}, "");
  const auto particles = drawn(frame.particles, "tone", Cut::open);

  const double high = round_above(size.quantile(shown_share, window));
  const AssemblyPicture magnitude = picture_of(0.0, high, displacement_colours(), "(mm)");
  const double spacing = points_of_window * x.h();
  std::vector<Bar> arrows;
  for (int row = 1; row < x.n_z(); row += points_of_window)
    for (int column = 1; column < x.n_x(); column += points_of_window) {
      const double u = x.at(column, row), w = z.at(column, row);
      const double scale = 1.5 * spacing / high;
      if (!std::isfinite(u) || std::hypot(u, w) < 0.05 * high) continue;
      const double limit = std::min(1.0, high / std::hypot(u, w));
      add_arrow(arrows, x.x(column), x.z(row), scale * limit * u, scale * limit * w,
                0.06 * spacing);
    }
  SectionPanel increment =
      panel_of("displacement since the frame before", size, magnitude, window);
  increment.actors.push_back(bars(arrows, Before::face));
  draw_sections(page, frame.pile,
                {{"layers that were horizontal, half a diameter thick",
                  {spheres(particles, lookup_table(tones))},
                  {},
                  window},
                 increment},
                caption);
}

void draw_principal(Page& page, const ResultFrame& frame, vtkImageData* fields,
                    const std::string& caption)
{
  const auto part = [&](int k) {
    return SectionValues(fields, "stress [Pa]", 6, component(k, -MPa));
  };
  const SectionValues s_x = part(xx), s_z = part(zz), s_xz = part(xz),
                      major(fields, "major principal stress [Pa]", 1, component(0, MPa)),
                      angle(fields, "major principal direction [-]", 3, [](const double*n) {
                        return 180.0 / dem::pi *
                               std::acos(std::clamp(std::abs(n[2]), 0.0, 1.0));
                      });
  const Window window = window_around(frame.pile, s_x);
  const double spacing = points_of_window * s_x.h();
  const double largest = round_above(major.quantile(0.9, window));
  std::vector<Bar> crosses;
  for (int row = 1; row < s_x.n_z(); row += points_of_window)
    for (int column = 1; column < s_x.n_x(); column += points_of_window) {
      const double a = s_x.at(column, row), b = s_z.at(column, row),
                   c = s_xz.at(column, row);
      if (!std::isfinite(a)) continue;
      const double turn = 0.5 * std::atan2(2.0 * c, a - b), mean = 0.5 * (a + b),
                   radius = std::hypot(0.5 * (a - b), c);
      const auto add = [&](double stress, double along) {
        const double half = 0.5 * spacing * std::min(2.0, std::abs(stress) / largest);
        const double dx = half * std::cos(along), dz = half * std::sin(along);
        crosses.push_back({s_x.x(column) - dx, s_x.z(row) - dz, s_x.x(column) + dx,
                           s_x.z(row) + dz, 0.09 * spacing,
                           stress < 0.0 ? pulled : compressed});
      };
      add(mean + radius, turn);
      add(mean - radius, turn + 0.5 * dem::pi);
    }
  char title[200];
  std::snprintf(title, sizeof title,
                "principal stresses: blue compression, red tension;\n"
                "%g MPa reach to the next cross, twice that at most",
                largest);
  draw_sections(
      page, frame.pile,
      {{title, {bars(crosses, Before::face)}, {}, window},
       panel_of("angle of the major principal stress\nto the vertical", angle,
                picture_of(0.0, 90.0, displacement_colours(), "(degree)"), window)},
      caption);
}

} // namespace

void draw_fields(const Options& options, const std::filesystem::path& output,
                 const ResultFrame& frame, const ContinuumFrame& continuum,
                 double porosity_at_start, const std::string& caption)
{
  const auto draw = [&](const char* name, std::size_t n_panels, auto&& draw_on) {
    const PictureSize size = size_of(options, n_panels);
    Page page(size.width, size.height);
    draw_on(page);
    save(page, output / name);
  };
  vtkImageData* fields = continuum.section;
  draw("stress.png", 4, [&](Page& page) { draw_stress(page, frame, fields, caption); });
  draw("porosity.png", 2,
       [&](Page& page) { draw_porosity(page, frame, fields, porosity_at_start, caption); });
  draw("layers.png", 2, [&](Page& page) { draw_layers(page, frame, fields, caption); });
  draw("principal.png", 2,
       [&](Page& page) { draw_principal(page, frame, fields, caption); });
  draw("chains.png", 2, [&](Page& page) { draw_chains(page, frame, continuum, caption); });
}

} // namespace mergel::apps
