/// The mesh of the far field: half a chamber, or a whole one, less the DEM region,
/// hexahedra.
///
/// Axis z up, ground surface z = 0; of a half model the cut plane is y = 0 and the rock at
/// y >= 0. The plan (see meshes/README.md) is an O-grid under the DEM region and rings
/// around it, mirror symmetric in x. That of a whole chamber is the half and its mirror image
/// in y. Its rings are extruded over the depth of the DEM region, the complete plan below it.
#pragma once

#include "fem/far_field/far_field_geometry.h"

#include <deal.II/grid/tria.h>

namespace mergel::fem {

/// Fill an empty triangulation and set the ids of boundary_ids.h. All nodes of the
/// interface lie at r = R_d or z = -H_d.
void make_far_field_mesh(const FarFieldGeometry& g, const FarFieldLayers& n,
                         dealii::Triangulation<3>& mesh);

} // namespace mergel::fem
