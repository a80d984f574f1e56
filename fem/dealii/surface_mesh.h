/// Meshes of membranes: triangles in space.
#pragma once

#include "fem/membrane/tube.h"

#include <deal.II/grid/tria.h>

namespace mergel::fem {

/// Nodes and triangles of a triangulation of triangles, both in its order.
/// @throws std::invalid_argument when it has another kind of cell
SurfaceMesh surface_of(const dealii::Triangulation<2, 3>& mesh);

/// The triangles of Tube.
SurfaceMesh tube_surface(const Tube& tube);

} // namespace mergel::fem
