/// Fields on a regular grid for ParaView (.vti); see dem/io/vtk.h.
#pragma once

#include "dem/io/vtk.h"

namespace mergel::dem {

/// Points of a regular grid, x varying fastest.
struct PointGrid {
  Vec3 origin = Vec3::Zero();    ///< of the first point [m]
  double h = 0.0;                ///< distance of the points along each axis [m]
  std::array<int, 3> n{1, 1, 1}; ///< points along each axis
  std::size_t size() const;
};

/// Writes as write_points() does, and throws as it does.
void write_grid(const std::filesystem::path& file, const PointGrid& grid,
                const std::vector<Field>& point_fields);

} // namespace mergel::dem
