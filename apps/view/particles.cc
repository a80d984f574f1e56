#include "apps/view/particles.h"

#include <cmath>

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

namespace mergel::apps {

Bounds bounds(vtkDataSet* data)
{
  Bounds result;
  data->GetBounds(result.data());
  return result;
}

std::vector<Colour> damage_colours()
{
  return {{0.94, 0.91, 0.83},
          {0.96, 0.75, 0.50},
          {0.90, 0.47, 0.28},
          {0.72, 0.17, 0.16},
          {0.38, 0.02, 0.08}};
}

AssemblyPicture damage_picture()
{
  AssemblyPicture picture;
  picture.array = "damage";
  picture.colours = damage_colours();
  picture.legend = "damage of\nthe bonds";
  return picture;
}

std::vector<Colour> displacement_colours()
{
  return {{0.95, 0.96, 0.92},
          {0.66, 0.83, 0.83},
          {0.33, 0.63, 0.75},
          {0.16, 0.39, 0.62},
          {0.08, 0.13, 0.37}};
}

vtkSmartPointer<vtkLookupTable> lookup_table(const AssemblyPicture& picture)
{
  vtkNew<vtkColorTransferFunction> blend;
  blend->SetColorSpaceToLab();
  for (std::size_t k = 0; k < picture.colours.size(); ++k) {
    const Colour& c = picture.colours[k];
    blend->AddRGBPoint(static_cast<double>(k), c[0], c[1], c[2]);
  }
  constexpr int n = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(n);
  for (int k = 0; k < n; ++k) {
    const double s =
        static_cast<double>(k) / (n - 1) * static_cast<double>(picture.colours.size() - 1);
    const double* c = blend->GetColor(s);
    table->SetTableValue(k, c[0], c[1], c[2]);
  }
  table->SetRange(picture.low, picture.high);
  if (picture.is_logarithmic) table->SetScaleToLog10();
  return table;
}

vtkSmartPointer<vtkPolyData> drawn(vtkPolyData* particles, const std::string& array,
                                   Cut cut)
{
  vtkDataArray* radius = particles->GetPointData()->GetArray("radius");
  vtkDataArray* shown = particles->GetPointData()->GetArray(array.c_str());
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices; // the sphere mapper draws points that belong to one
  vtkNew<vtkFloatArray> R;       // the sphere mapper reads floats whatever the array's type
  vtkNew<vtkDoubleArray> value;
  R->SetName("radius");
  value->SetName(array.c_str());
  for (vtkIdType p = 0; p < particles->GetNumberOfPoints(); ++p) {
    std::array<double, 3> x;
    particles->GetPoint(p, x.data());
    if (cut == Cut::open && x[1] < -1e-3 * radius->GetTuple1(p))
      continue; // round-off on the plane is kept
    vertices->InsertNextCell(1);
    vertices->InsertCellPoint(points->InsertNextPoint(x.data()));
    R->InsertNextValue(static_cast<float>(radius->GetTuple1(p)));
    value->InsertNextValue(shown->GetTuple1(p));
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetVerts(vertices);
  result->GetPointData()->AddArray(R);
  result->GetPointData()->SetScalars(value);
  return result;
}

vtkSmartPointer<vtkActor> spheres(vtkPolyData* drawn, vtkLookupTable* table)
{
  vtkNew<vtkOpenGLSphereMapper> mapper; // one shaded quad per sphere
  mapper->SetInputData(drawn);
  mapper->SetScaleArray("radius");
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.70);
  return actor;
}

void look_along_y(vtkRenderer* scene, const Window& window)
{
  vtkCamera* camera = scene->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(window.x_middle, 0.0, window.z_middle);
  camera->SetPosition(window.x_middle, -10.0 * window.height, window.z_middle);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetParallelScale(0.5 * window.height);
  scene->ResetCameraClippingRange();

  // Directions from the picture: a lamp over the left shoulder, and a weak one at the eye.
  scene->AutomaticLightCreationOff();
  vtkNew<vtkLight> lamp, eye;
  lamp->SetLightTypeToCameraLight();
  lamp->SetPosition(-0.7, 0.4, 1.2);
  lamp->SetIntensity(0.7);
  eye->SetLightTypeToHeadlight();
  eye->SetIntensity(0.4);
  scene->AddLight(lamp);
  scene->AddLight(eye);
}

namespace {

/// Position of a value on the colour bar: 0 at its foot, 1 at its head.
double fraction(const AssemblyPicture& picture, double value)
{
  if (picture.is_logarithmic)
    return std::log(value / picture.low) / std::log(picture.high / picture.low);
  return (value - picture.low) / (picture.high - picture.low);
}

/// Values written beside the colour bar.
std::vector<double> legend_ticks(const AssemblyPicture& picture)
{
  if (!picture.is_logarithmic) return round_ticks(picture.low, picture.high, 5);
  std::vector<double> decades;
  for (const double k : round_ticks(std::log10(picture.low), std::log10(picture.high), 4))
    decades.push_back(std::pow(10.0, k));
  return decades;
}

} // namespace

void draw_legend(Page& page, const Box& bar, const AssemblyPicture& picture,
                 vtkLookupTable* table)
{
  const double u = page.unit();
  const vtkIdType n = table->GetNumberOfTableValues();
  for (vtkIdType k = 0; k < n;
       ++k) { // the table's entries are evenly spaced on either scale
    const double* c = table->GetTableValue(k);
    const double from = static_cast<double>(k) / static_cast<double>(n);
    const double to = static_cast<double>(k + 1) / static_cast<double>(n);
    page.fill({bar.left, bar.bottom + bar.height() * from, bar.right,
               bar.bottom + bar.height() * to},
              {c[0], c[1], c[2]});
  }
  page.line({{bar.left, bar.bottom},
             {bar.right, bar.bottom},
             {bar.right, bar.top},
             {bar.left, bar.top},
             {bar.left, bar.bottom}},
            ink, 1.8);
  for (const double value : legend_ticks(picture)) {
    const double y = bar.bottom + bar.height() * fraction(picture, value);
    page.line({{bar.right, y}, {bar.right + 8.0 * u, y}}, ink, 1.8);
    page.text({bar.right + 16.0 * u, y}, tick_text(value), {0.9, Across::left});
  }
  page.text({bar.left, bar.top + 22.0 * u}, picture.legend, {1.0, Across::left, Up::foot});
}

} // namespace mergel::apps
