/// A grid over the vertical section y = 0 of a cylinder, seen from its half y >= 0. Its cells are
/// quarter rings about the z axis: those of the quarter x < 0 to the left of the axis, those of
/// x > 0 to the right.
#pragma once

#include "dem/notation.h"
#include "dem/walls/rigid_wall.h"

#include <cstddef>

namespace mergel::dem {

/// Directions in the section at a point: right (away from the axis where x > 0, towards it where
/// x < 0), into the half cylinder, up. On the plane y = 0 they are x, y and z.
/// @param x position; @param is_left whether the quarter x < 0 is meant
Mat3 section_axes(const Vec3& x, bool is_left);

struct SectionGrid {
  double h = 0.0;     ///< height and width of a cell [m]
  double z_low = 0.0; ///< of the lowest cells [m]
  double depth = 0.0; ///< of the cylinder, which ends inside the lowest cells [m]
  int n_r = 0;        ///< cells from the axis outwards, on each side
  int n_z = 0;        ///< cells from the lowest upwards

  int n_columns() const { return 2 * n_r; }
  std::size_t size() const
  {
    return static_cast<std::size_t>(n_columns()) * static_cast<std::size_t>(n_z);
  }
  std::size_t index(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_columns()) +
           static_cast<std::size_t>(column);
  }
  /// Distance of the cell's middle from the axis, negative where x < 0 [m].
  double r_middle(int column) const { return (column - n_r + 0.5) * h; }
  double z_middle(int row) const { return z_low + (row + 0.5) * h; } ///< [m]
  bool is_left(int column) const { return column < n_r; }

  /// Number of the cell that holds x; -1 outside of the grid and where y < 0.
  std::ptrdiff_t cell_at(const Vec3& x) const;

  /// Volume of a cell less what the pile takes of it when it stands at x on the
  /// axis [m^3]. The height of the cell is divided into ten for that.
  double volume(int column, int row, const RigidShape* pile, const Vec3& x) const;
};

/// The grid of a half cylinder below z = 0, and some way above.
/// @param radius, depth of the half cylinder [m]; @param above largest height [m]
/// @param h_most the cells are at most as wide, and the radius is a multiple of them [m], > 0
SectionGrid make_section_grid(double radius, double depth, double above, double h_most);

} // namespace mergel::dem
