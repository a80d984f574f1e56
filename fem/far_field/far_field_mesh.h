/// The mesh of the far field: half a chamber, or a whole one, less the DEM region,
/// hexahedra.
///
/// Axis z up, ground surface z = 0; of a half model the cut plane is y = 0 and the rock at
/// y >= 0. The plan (see meshes/README.md) is an O-grid under the DEM region and rings
/// around it, mirror symmetric in x. That of a whole chamber is the half and its mirror image
/// in y. Its rings are extruded over the depth of the DEM region, the complete plan below it.
#pragma once

#include "fem/far_field/far_field.h"

#include <deal.II/grid/tria.h>

namespace mergel::fem {

/// Size of the model. The user gives sizes; layers() derives the counts.
struct FarFieldGeometry {
  double chamber_radius, chamber_height; ///< R_c, H_c [m]
  double region_radius, region_height;   ///< R_d, H_d [m], less than the chamber's
  double cell_size;                      ///< edge of the cells at the interface [m]
  double growth; ///< mesh growth ratio: of neighbouring cells, outwards [-], >= 1
  Extent extent = Extent::half; ///< half of the chamber, or all of it
};

/// Numbers of cells in each direction.
struct FarFieldLayers {
  int n_around; ///< over 180 degrees; a multiple of 4, at least 8
  int n_ring;   ///< rings between the rectangular core and r = R_d
  int n_radial; ///< graded rings from R_d to R_c
  int n_upper;  ///< layers over the depth of the DEM region
  int n_lower;  ///< graded layers below it

  /// Cells of the whole mesh; a double, because a mistaken cell size must not overflow.
  double n_cells(Extent extent) const;
};

/// Counts whose cells come closest to the wanted cell size and mesh growth ratio.
FarFieldLayers layers(const FarFieldGeometry& g);

/// Fill an empty triangulation and set the ids of boundary_ids.h. All nodes of the
/// interface lie at r = R_d or z = -H_d.
void make_far_field_mesh(const FarFieldGeometry& g, const FarFieldLayers& n,
                         dealii::Triangulation<3>& mesh);

} // namespace mergel::fem
