#include "apps/view/pile/scene.h"

#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCleanPolyData.h>
#include <vtkCutter.h>
#include <vtkExtractEdges.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkWarpVector.h>

namespace mergel::apps {

namespace {

const Colour far_assembly{0.955, 0.95, 0.935};
const Colour mesh_edge{0.80, 0.79, 0.77};

/// The section of the far field just behind y = 0, and the mesh in it.
struct Section {
  vtkSmartPointer<vtkActor> face, edges;
};

Section section(vtkUnstructuredGrid* far_field, const AssemblyPicture& picture,
                vtkLookupTable* table)
{
  vtkNew<vtkWarpVector> moved; // at present positions, as the particles are
  moved->SetInputData(far_field);
  moved->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS,
                                "displacement");
  const Bounds b = bounds(far_field);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.0, 1.0, 0.0);
  plane->SetOrigin(0.0, 1e-4 * (b[1] - b[0]), 0.0); // inside the elements that end at y = 0
  vtkNew<vtkCutter> cut;
  cut->SetInputConnection(moved->GetOutputPort());
  cut->SetCutFunction(plane);
  cut->GenerateTrianglesOff();

  vtkNew<vtkPolyDataMapper> face_mapper;
  face_mapper->SetInputConnection(cut->GetOutputPort());
  face_mapper->SetScalarVisibility(picture.is_far_field_coloured ? 1 : 0);
  if (picture.is_far_field_coloured) {
    face_mapper->SetScalarModeToUsePointFieldData();
    face_mapper->SelectColorArray(picture.array.c_str());
    face_mapper->SetLookupTable(table);
    face_mapper->UseLookupTableScalarRangeOn();
    face_mapper->InterpolateScalarsBeforeMappingOn();
  }
  auto face = vtkSmartPointer<vtkActor>::New();
  face->SetMapper(face_mapper);
  face->GetProperty()->SetColor(far_assembly[0], far_assembly[1], far_assembly[2]);
  face->GetProperty()->LightingOff();

  vtkNew<vtkExtractEdges> lines;
  lines->SetInputConnection(cut->GetOutputPort());
  vtkNew<vtkPolyDataMapper> edge_mapper;
  edge_mapper->SetInputConnection(lines->GetOutputPort());
  edge_mapper->ScalarVisibilityOff();
  edge_mapper->SetResolveCoincidentTopologyToPolygonOffset();
  auto edges = vtkSmartPointer<vtkActor>::New();
  edges->SetMapper(edge_mapper);
  edges->GetProperty()->SetColor(mesh_edge[0], mesh_edge[1], mesh_edge[2]);
  edges->GetProperty()->SetLineWidth(2.0F);
  edges->GetProperty()->LightingOff();
  return {face, edges};
}

/// Where the panels go, and what they show.
struct Layout {
  Box main, close_up, bar;
  Window whole, tip;
  bool has_close_up = false;
};

/// Distance from the axis [mm] within which nearly all particles lie; debris is farther
/// off.
double region_radius(vtkPolyData* particles)
{
  std::vector<double> x(static_cast<std::size_t>(particles->GetNumberOfPoints()));
  for (std::size_t p = 0; p < x.size(); ++p)
    x[p] = std::abs(particles->GetPoint(static_cast<vtkIdType>(p))[0]);
  const auto k = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), x.begin() + k, x.end());
  return 1.05 * x[static_cast<std::size_t>(k)];
}

Layout layout(const Page& page, const ResultFrame& frame)
{
  const double u = page.unit();
  const double left = 130.0 * u, top = page.height() - 90.0 * u;
  const double legend = 250.0 * u, gap = 105.0 * u;
  const double room = page.width() - legend - left;

  const Bounds dem = bounds(frame.particles);
  const double radius = region_radius(frame.particles);
  const double depth = -dem[4]; // the surface is z = 0
  const double above = std::clamp(bounds(frame.pile)[5], 0.0, 0.3 * depth) + 0.05 * depth;
  Layout result;
  Window& whole = result.whole;
  whole.height = above + 1.08 * depth; // a strip of far field below, the pile above
  whole.z_middle = above - 0.5 * whole.height;
  whole.x_middle = 0.0;

  // As high as the page, unless that would leave no room for the width.
  const double smallest_width = 2.3 * radius, good_width = 2.7 * radius;
  const double px_per_mm =
      std::min((top - 115.0 * u) / whole.height, room / smallest_width);
  const double height = whole.height * px_per_mm, bottom = top - height;
  double main_width = std::min(room, std::max(good_width, 0.5 * whole.height) * px_per_mm);

  const double close_up = room - main_width - gap;
  result.has_close_up = close_up > 0.4 * height;
  if (!result.has_close_up) main_width = room;
  whole.width = main_width / px_per_mm;
  result.main = {left, bottom, left + main_width, top};

  if (result.has_close_up) {
    result.close_up = {left + main_width + gap, bottom, left + room, top};
    const Bounds p = bounds(frame.pile);
    result.tip.width = 6.0 * (p[1] - p[0]);
    result.tip.height = result.tip.width * height / close_up;
    result.tip.x_middle = 0.0;
    result.tip.z_middle = p[4] + 0.1 * result.tip.height;
  }
  result.bar = {page.width() - legend + 45.0 * u, bottom + 0.25 * height,
                page.width() - legend + 85.0 * u, bottom + 0.75 * height};
  return result;
}

} // namespace

vtkSmartPointer<vtkActor> pile_actor(vtkPolyData* surface)
{
  vtkNew<vtkAppendPolyData> whole;
  whole->AddInputData(surface);
  const Bounds b = bounds(surface);
  if (b[2] > -0.1 * b[3]) {
    vtkNew<vtkTransform> mirror;
    mirror->Scale(1.0, -1.0, 1.0);
    vtkNew<vtkTransformPolyDataFilter> image;
    image->SetInputData(surface);
    image->SetTransform(mirror);
    image->Update();
    whole->AddInputData(image->GetOutput());
  }
  vtkNew<vtkCleanPolyData> joined; // one set of normals across the seam
  joined->SetInputConnection(whole->GetOutputPort());
  joined->SetTolerance(1e-6);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(joined->GetOutputPort());
  normals->SetFeatureAngle(20.0); // the shoulder of a 60 degree cone has 30
  normals->ConsistencyOn();
  normals->AutoOrientNormalsOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetColor(steel[0], steel[1], steel[2]);
  look->SetAmbient(0.25);
  look->SetDiffuse(0.75);
  look->SetSpecular(0.35);
  look->SetSpecularPower(25.0);
  return actor;
}

void draw_assembly(Page& page, const ResultFrame& frame, const AssemblyPicture& picture)
{
  const auto table = lookup_table(picture);
  const auto particles = drawn(frame.particles, picture.array, Cut::open);
  const Layout where = layout(page, frame);

  const auto draw = [&](const Box& box, const Window& window, const std::string& z_title) {
    vtkRenderer* scene = page.scene(box);
    const Section far_field = section(frame.far_field, picture, table);
    scene->AddActor(far_field.face);
    scene->AddActor(far_field.edges);
    scene->AddActor(spheres(particles, table));
    scene->AddActor(pile_actor(frame.pile));
    look_along_y(scene, window);

    Panel panel;
    panel.box = box;
    panel.x = {window.left(), window.right(), "x (mm)"};
    panel.y = {window.bottom(), window.top(), z_title};
    draw_axes(page, panel);
    return panel;
  };

  const Panel main = draw(where.main, where.whole, "z (mm)");
  if (where.has_close_up) {
    draw(where.close_up, where.tip, "");
    const Pixel low = main.at(where.tip.left(), where.tip.bottom());
    const Pixel high = main.at(where.tip.right(), where.tip.top());
    page.line({low, {high.x, low.y}, high, {low.x, high.y}, low}, ink, 2.5);
  }
  draw_legend(page, where.bar, picture, table);
  page.text({where.main.left, where.main.top + 25.0 * page.unit()}, picture.caption,
            {1.1, Across::left, Up::foot});
}

} // namespace mergel::apps
