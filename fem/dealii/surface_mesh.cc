#include "fem/dealii/surface_mesh.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mergel::fem {

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

SurfaceMesh tube_surface(const Tube& tube)
{
  std::vector<dealii::Point<3>> x;
  for (int j = 0; j <= tube.n_high; ++j)
    for (int i = 0; i < tube.n_around; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / tube.n_around;
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
  dealii::Triangulation<2, 3> mesh;
  mesh.create_triangulation(x, cells, dealii::SubCellData());
  return surface_of(mesh);
}

} // namespace mergel::fem
