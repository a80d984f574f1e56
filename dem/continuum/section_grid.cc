#include "dem/continuum/section_grid.h"

#include "dem/walls/wall_readings.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

Mat3 section_axes(const Vec3& x, bool is_left)
{
  const double r = std::hypot(x.x(), x.y());
  const double side = is_left ? -1.0 : 1.0;
  const Vec3 right =
      r > 0.0 ? Vec3(side * x.x() / r, side * x.y() / r, 0.0) : Vec3::UnitX();
  Mat3 axes;
  axes.row(0) = right;
  axes.row(1) = Vec3(-right.y(), right.x(), 0.0);
  axes.row(2) = Vec3::UnitZ();
  return axes;
}

std::ptrdiff_t SectionGrid::cell_at(const Vec3& x) const
{
  if (x.y() < 0.0) return -1;
  const double r = std::sqrt(x.x() * x.x() + x.y() * x.y()) / h, z = (x.z() - z_low) / h;
  if (!(r < n_r) || !(z >= 0.0) || !(z < n_z)) return -1;
  const int ring = static_cast<int>(r);
  const int column = x.x() < 0.0 ? n_r - 1 - ring : n_r + ring;
  return static_cast<std::ptrdiff_t>(index(column, static_cast<int>(z)));
}

double SectionGrid::volume(int column, int row, const RigidShape* pile, const Vec3& x) const
{
  constexpr int n = 10;
  const double inner = (std::abs(column - n_r + 0.5) - 0.5) * h, outer = inner + h;
  double area = 0.0; // mean over the height, of a quarter ring [m^2]
  for (int k = 0; k < n; ++k) {
    const double z = z_low + (row + (k + 0.5) / n) * h;
    if (z < -depth) continue;
    const double from = std::max(inner, pile ? radius_at(*pile, z - x.z()) : 0.0);
    if (from < outer) area += 0.25 * pi * (outer * outer - from * from) / n;
  }
  return area * h;
}

SectionGrid make_section_grid(double radius, double depth, double above, double h_most)
{
  const auto cells = [](double length, double h) {
    return std::max(1, static_cast<int>(std::ceil(length / h * (1.0 - 1e-12))));
  };
  SectionGrid grid;
  grid.n_r = cells(radius, h_most);
  grid.h = radius / grid.n_r;
  grid.depth = depth;
  const int below = cells(depth, grid.h);
  grid.n_z = below + cells(above, grid.h);
  grid.z_low = -below * grid.h;
  return grid;
}

} // namespace mergel::dem
