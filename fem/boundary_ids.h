/// Boundary ids of the far-field mesh, one name each. meshes/README.md describes them.
#pragma once

namespace mergel::fem::boundary {

/// r = R_d, -H_d < z < 0: lateral face towards the DEM region
inline constexpr int interface_side = 1;
inline constexpr int interface_bottom = 2; ///< z = -H_d, r < R_d: floor of the DEM region
inline constexpr int symmetry = 3;         ///< y = 0: the cut plane of the half model
inline constexpr int outer = 4;            ///< r = R_c: wall of the chamber
inline constexpr int bottom = 5;           ///< z = -H_c: base of the chamber
inline constexpr int top = 6;              ///< z = 0: ground surface outside the DEM region

} // namespace mergel::fem::boundary
