/// Sizes of the far field and the numbers of cells that follow from them (meshes/README.md).
#pragma once

#include "fem/far_field/far_field.h"

namespace mergel::fem {

/// Size of the model. The user gives sizes; layers() derives the counts.
struct FarFieldGeometry {
  double chamber_radius, chamber_height; ///< R_c, H_c [m]
  double region_radius, region_height;   ///< R_d, H_d [m], less than the chamber's
  double cell_size;                      ///< edge of the cells at the interface [m]
  double growth; ///< mesh growth ratio: of neighbouring cells, outwards [-], >= 1
  Extent extent = Extent::half; ///< half of the chamber, or all of it
};

FarFieldGeometry geometry(const FarFieldSpec& spec);

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

} // namespace mergel::fem
