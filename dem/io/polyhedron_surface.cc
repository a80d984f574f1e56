#include "dem/io/polyhedron_surface.h"

#include "dem/io/vtk.h"

#include <algorithm>
#include <utility>

namespace mergel::dem {

namespace {

using Segment = std::array<Vec3, 2>;

/// Triangles of the area that segments in a plane enclose: strips between the heights of their
/// ends along the axis v, from side to side along u.
void add_face(TriangleSoup& to, const std::vector<Segment>& border, Eigen::Index u,
              Eigen::Index v)
{
  std::vector<double> heights;
  for (const Segment& s : border)
    for (const Vec3& end : s) heights.push_back(end[v]);
  std::sort(heights.begin(), heights.end());
  for (std::size_t k = 1; k < heights.size(); ++k) {
    const double low = heights[k - 1], high = heights[k], middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) continue;
    const auto at = [&](const Segment& s, double height) {
      return Vec3(s[0] + (height - s[0][v]) / (s[1][v] - s[0][v]) * (s[1] - s[0]));
    };
    std::vector<std::pair<double, Segment>> sides; // u in the middle, from low to high
    for (const Segment& s : border) {
      if ((s[0][v] < middle) == (s[1][v] < middle)) continue;
      sides.push_back({at(s, middle)[u], {at(s, low), at(s, high)}});
    }
    std::sort(sides.begin(), sides.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
      const Segment &a = sides[i].second, &b = sides[i + 1].second;
      to.push_back({a[0], b[0], b[1]});
      to.push_back({a[0], b[1], a[1]});
    }
  }
}

/// The part of a polyhedron up to a height above its lowest point.
TriangleSoup lower_part(const Polyhedron& polyhedron, double height)
{
  TriangleSoup soup;
  for (const Triangle& t : polyhedron.surface.topology.triangles)
    soup.push_back({polyhedron.surface.x[uz(t[0])], polyhedron.surface.x[uz(t[1])],
                    polyhedron.surface.x[uz(t[2])]});
  return height < polyhedron.length ? cut_off(soup, 2, height, -1.0) : soup;
}

void write_soup(const std::filesystem::path& file, const TriangleSoup& soup, const Vec3& x,
                const Eigen::Quaterniond& rotation)
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (const auto& t : soup) {
    const auto first = static_cast<Index>(points.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const Vec3& corner : t) points.push_back(x + rotation * corner);
  }
  write_surface(file, points, triangles, {});
}

double height_of_top(const Polyhedron& polyhedron, const Vec3& x, double z_top)
{
  return std::max(z_top - x.z(), polyhedron.tip_height);
}

} // namespace

TriangleSoup cut_off(const TriangleSoup& polyhedron, Eigen::Index axis, double at,
                     double side)
{
  TriangleSoup part;
  std::vector<Segment> border;
  for (const auto& t : polyhedron) {
    std::vector<Vec3> corners, on_plane;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = t[k], &b = t[(k + 1) % 3];
      const double here = side * (a[axis] - at), next = side * (b[axis] - at);
      if (here >= 0.0) corners.push_back(a);
      if ((here >= 0.0) == (next >= 0.0)) continue;
      on_plane.push_back(a + here / (here - next) * (b - a)); // they differ
      corners.push_back(on_plane.back());
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
      part.push_back({corners[0], corners[k - 1], corners[k]});
    if (on_plane.size() == 2) border.push_back({on_plane[0], on_plane[1]});
  }
  add_face(part, border, (axis + 1) % 3, (axis + 2) % 3);
  return part;
}

void write_half_polyhedron(const std::filesystem::path& file, const Polyhedron& polyhedron,
                           const Vec3& x, const Eigen::Quaterniond& rotation, double z_top)
{
  const TriangleSoup soup = lower_part(polyhedron, height_of_top(polyhedron, x, z_top));
  write_soup(file, cut_off(soup, 1, 0.0, 1.0), x, rotation);
}

void write_polyhedron(const std::filesystem::path& file, const Polyhedron& polyhedron,
                      const Vec3& x, const Eigen::Quaterniond& rotation, double z_top)
{
  write_soup(file, lower_part(polyhedron, height_of_top(polyhedron, x, z_top)), x,
             rotation);
}

} // namespace mergel::dem
