#include "apps/view/specimen.h"

#include "apps/view/particles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

namespace mergel::apps {

namespace {

const Colour latex{0.35, 0.55, 0.80};
constexpr double opacity_of_membrane = 0.2;

vtkSmartPointer<vtkActor> membrane(vtkPolyData* surface)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(60.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetColor(latex[0], latex[1], latex[2]);
  look->SetOpacity(opacity_of_membrane);
  return actor;
}

/// "axial strain 2 %   q 3.1 MPa   time 4.36 ms   62 bonds broken", as in the history.
std::string caption(const dem::Table& history, double time)
{
  const std::vector<double>& t = history.column("time", "s");
  const auto at = [&](const char* name, const char* unit) {
    return dem::interpolate(t, history.column(name, unit), time);
  };
  const double q = 0.01 * std::round(1e-4 * at("q", "Pa")) + 0.0; // MPa; 0 has no sign
  char text[160];
  std::snprintf(
      text, sizeof text,
      "axial strain %.3g %%     q %.2f MPa     time %.4g ms     %.0f bonds broken",
      100.0 * at("axial strain", "-"), q, 1e3 * time, at("broken bonds", "-"));
  return text;
}

} // namespace

PlatenFace platen_face(vtkPolyData* platens, bool is_upper)
{
  const Bounds b = bounds(platens);
  const double middle = 0.5 * (b[4] + b[5]), infinity = std::numeric_limits<double>::max();
  PlatenFace face{infinity, 0.0, -infinity, 0.0};
  for (vtkIdType k = 0; k < platens->GetNumberOfPoints(); ++k) {
    const double* x = platens->GetPoint(k);
    if ((x[2] > middle) != is_upper) continue;
    if (x[0] < face.x_0) face.x_0 = x[0], face.z_0 = x[2];
    if (x[0] > face.x_1) face.x_1 = x[0], face.z_1 = x[2];
  }
  return face;
}

void draw_platen(Page& page, const Panel& panel, const PlatenFace& face, double thickness)
{
  const double left = std::max(face.x_0, panel.x.from),
               right = std::min(face.x_1, panel.x.to);
  page.fill({panel.at(left, face.at(left)), panel.at(right, face.at(right)),
             panel.at(right, face.at(right) + thickness),
             panel.at(left, face.at(left) + thickness)},
            steel);
}

void draw_specimen(Page& page, const SpecimenFrame& frame, const dem::Table& history)
{
  const AssemblyPicture picture = damage_picture();
  const auto table = lookup_table(picture);
  const double u = page.unit();
  const PlatenFace upper = platen_face(frame.platens, true),
                   lower = platen_face(frame.platens, false);
  const Bounds inside = bounds(frame.membrane ? frame.membrane : frame.particles);
  const double height = std::max(upper.z_0, upper.z_1) - std::min(lower.z_0, lower.z_1);
  const double thickness = thickness_of_platens * height;

  const double left = 130.0 * u, gap = 60.0 * u, legend = 250.0 * u;
  const double top = page.height() - 90.0 * u, bottom = 115.0 * u;
  Window window{0.5 * (inside[0] + inside[1]), 0.5 * (inside[4] + inside[5]),
                1.15 * (inside[1] - inside[0]), height + 3.0 * thickness};
  // As high as the page, unless that would leave no room for the width.
  const double room = 0.5 * (page.width() - legend - left - gap);
  const double px_per_mm = std::min((top - bottom) / window.height, room / window.width);
  const double width = window.width * px_per_mm, z_from = top - window.height * px_per_mm;

  const auto draw = [&](double x, Cut cut, const std::string& z_title) {
    const Box box{x, z_from, x + width, top};
    vtkRenderer* scene = page.scene(box);
    scene->AddActor(spheres(drawn(frame.particles, picture.array, cut), table));
    if (cut == Cut::whole && frame.membrane) scene->AddActor(membrane(frame.membrane));
    look_along_y(scene, window);
    Panel panel;
    panel.box = box;
    panel.x = {window.left(), window.right(), "x (mm)"};
    panel.y = {window.bottom(), window.top(), z_title};
    draw_platen(page, panel, upper, thickness);
    draw_platen(page, panel, lower, -thickness);
    draw_axes(page, panel);
  };
  draw(left, Cut::whole, "z (mm)");
  draw(left + width + gap, Cut::open, "");
  const double bar = left + 2.0 * width + gap + 45.0 * u, bar_height = top - z_from;
  draw_legend(page,
              {bar, z_from + 0.25 * bar_height, bar + 40.0 * u, z_from + 0.75 * bar_height},
              picture, table);
  page.text({left, top + 25.0 * u}, caption(history, frame.time),
            {1.1, Across::left, Up::foot});
}

} // namespace mergel::apps
