#include "apps/view/pile/draw_chains.h"

#include "apps/view/pile/section_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>

namespace mergel::apps {

namespace {

const Colour compressed{0.05, 0.28, 0.55}, pulled{0.80, 0.13, 0.10};

/// Branches that begin and end within this distance of the plane y = 0 [mm].
std::vector<Bar> chains(vtkPolyData* contacts, double thickness, double& largest)
{
  vtkDataArray* force = contacts->GetCellData()->GetArray("normal force [N]");
  struct Line {
    double x_0, z_0, x_1, z_1, f_n;
  };
  std::vector<Line> lines;
  std::vector<double> sizes;
  vtkNew<vtkIdList> ends;
  for (vtkIdType k = 0; k < contacts->GetNumberOfCells(); ++k) {
    contacts->GetCellPoints(k, ends);
    if (ends->GetNumberOfIds() != 2) continue;
    double a[3], b[3];
    contacts->GetPoint(ends->GetId(0), a);
    contacts->GetPoint(ends->GetId(1), b);
    if (std::max(a[1], b[1]) > thickness) continue;
    lines.push_back({a[0], a[2], b[0], b[2], force->GetTuple1(k)});
    sizes.push_back(std::abs(lines.back().f_n));
  }
  largest = 0.0;
  if (lines.empty()) return {};
  const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), sizes.begin() + at, sizes.end());
  largest = round_above(sizes[static_cast<std::size_t>(at)]);
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::abs(a.f_n) < std::abs(b.f_n); // the strong ones on top
  });
  std::vector<Bar> list;
  const double widest = 0.25 * thickness;
  for (const Line& line : lines) {
    const double share = std::min(1.0, std::abs(line.f_n) / largest);
    if (share < 0.02) continue; // not to be seen
    list.push_back({line.x_0, line.z_0, line.x_1, line.z_1, share * widest,
                    line.f_n > 0.0 ? compressed : pulled});
  }
  return list;
}

/// Width of a typical particle beside the pile [mm].
double median_diameter(vtkPolyData* particles, double reach)
{
  vtkDataArray* radius = particles->GetPointData()->GetArray("radius");
  std::vector<double> d;
  for (vtkIdType p = 0; p < particles->GetNumberOfPoints(); ++p) {
    double x[3];
    particles->GetPoint(p, x);
    if (std::hypot(x[0], x[1]) < reach) d.push_back(2.0 * radius->GetTuple1(p));
  }
  if (d.empty()) return reach;
  std::nth_element(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(d.size() / 2),
                   d.end());
  return d[d.size() / 2];
}

} // namespace

void draw_chains(Page& page, const ResultFrame& frame, const ContinuumFrame& continuum,
                 const std::string& caption)
{
  const SectionValues any(continuum.section, "porosity [-]", 1, component(0));
  const Window whole = window_around(frame.pile, any);
  const Bounds pile = bounds(frame.pile);
  const double D = pile[1] - pile[0];
  const Window tip{0.0, pile[4] + 0.1 * D, 3.2 * D, 3.2 * D * whole.height / whole.width};
  const double thickness = 2.0 * median_diameter(frame.particles, D);
  double largest = 0.0;
  const auto lines =
      bars(chains(continuum.contacts, thickness, largest), Before::particles);

  AssemblyPicture picture = damage_picture();
  const auto particles =
      spheres(drawn(frame.particles, "damage", Cut::open), lookup_table(picture));
  char title[160];
  std::snprintf(title, sizeof title,
                "forces within %.2g mm of the section: blue compression,\n"
                "red tension; the widest %g N and more",
                thickness, largest);
  draw_sections(page, frame.pile,
                {{title, {particles, lines}, picture, whole},
                 {"around the tip", {particles, lines}, {}, tip}},
                caption);
}

} // namespace mergel::apps
