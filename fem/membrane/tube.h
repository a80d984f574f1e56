/// The mesh of a membrane, and the tube around a specimen.
#pragma once

#include "fem/nodal.h"

#include <array>

namespace mergel::fem {

using SurfaceTriangle = std::array<int, 3>; ///< numbers of its nodes

/// Nodes and triangles of a surface.
struct SurfaceMesh {
  std::vector<Vec3> x; ///< [m]
  std::vector<SurfaceTriangle> triangles;
};

/// Upright tube about the axis z. Rows of nodes from z_bottom up, every second one turned by
/// half a node distance: triangles are nearly equilateral, and their normals point inwards.
struct Tube {
  double radius = 0.0, z_bottom = 0.0, height = 0.0; ///< [m]; nodes lie on the radius
  int n_around = 0;                                  ///< nodes of a row, >= 3
  int n_high = 0;                                    ///< rows of triangles, >= 1

  /// The tube whose nodes are about `distance` [m] apart.
  static Tube with_node_distance(double radius, double z_bottom, double height,
                                 double distance);
  int n_nodes() const { return n_around * (n_high + 1); }
  int node(int around, int row) const { return row * n_around + around % n_around; }
  double node_distance() const; ///< the largest [m]
};

} // namespace mergel::fem
