#include "fem/membrane/membrane_mesh.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mergel::fem {

using std::numbers::pi;

SurfaceMesh surface_of(const dealii::Triangulation<2, 3>& mesh)
{
  SurfaceMesh surface;
  for (const auto& x : mesh.get_vertices()) surface.x.emplace_back(x[0], x[1], x[2]);
  for (const auto& cell : mesh.active_cell_iterators()) {
    if (cell->n_vertices() != 3)
      throw std::invalid_argument("a membrane is made of triangles");
    SurfaceTriangle t;
    for (unsigned k = 0; k < 3; ++k) t[k] = static_cast<int>(cell->vertex_index(k));
    surface.triangles.push_back(t);
  }
  return surface;
}

Tube Tube::with_node_distance(double radius, double z_bottom, double height,
                              double distance)
{
  const auto n = [](double length, double part) {
    return static_cast<int>(std::lround(std::min(length / part, 1e6)));
  };
  return {radius, z_bottom, height, std::max(3, n(2.0 * pi * radius, distance)),
          std::max(1, n(height, 0.5 * std::sqrt(3.0) * distance))};
}

double Tube::node_distance() const
{
  const double chord = 2.0 * radius * std::sin(pi / n_around), row = height / n_high,
               half = 2.0 * radius * std::sin(0.5 * pi / n_around);
  return std::max(chord, std::hypot(row, half));
}

void make_tube(const Tube& tube, dealii::Triangulation<2, 3>& mesh)
{
  std::vector<dealii::Point<3>> x;
  for (int j = 0; j <= tube.n_high; ++j)
    for (int i = 0; i < tube.n_around; ++i) {
      const double angle = 2.0 * pi * (i + 0.5 * (j % 2)) / tube.n_around;
      x.emplace_back(tube.radius * std::cos(angle), tube.radius * std::sin(angle),
                     tube.z_bottom + tube.height * j / tube.n_high);
    }
  std::vector<dealii::CellData<2>> cells;
  const auto add = [&](int a, int b, int c) {
    dealii::CellData<2> cell(3);
    cell.vertices = {static_cast<unsigned>(a), static_cast<unsigned>(b),
                     static_cast<unsigned>(c)};
    cells.push_back(cell);
  };
  for (int j = 0; j < tube.n_high; ++j)
    for (int i = 0; i < tube.n_around; ++i) {
      const int shift = j % 2; // the upper row is turned against the lower one
      const int below = tube.node(i, j), next = tube.node(i + 1, j),
                above = tube.node(i + shift, j + 1);
      const int before = tube.node(i + shift + tube.n_around - 1, j + 1);
      add(below, above, next);
      add(below, before, above);
    }
  mesh.create_triangulation(x, cells, dealii::SubCellData());
}

} // namespace mergel::fem
