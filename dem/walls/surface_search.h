/// Finds the triangles of a surface near a point: a binary tree of boxes around them.
#pragma once

#include "dem/walls/triangulated.h"

#include <Eigen/Geometry>

#include <optional>

namespace mergel::dem {

/// The closest point of a surface to another one.
struct NearestOnSurface {
  Anchor at;
  Vec3 point;      ///< [m]
  double distance; ///< [m]
};

/// What it finds depends on the surface alone: the same on all ranks.
class SurfaceSearch {
public:
  SurfaceSearch() = default;
  SurfaceSearch(const std::vector<Vec3>& x, const std::vector<Triangle>& triangles);

  /// Numbers of the triangles whose boxes come within `reach` [m] of c, ascending: all those
  /// that come as near, and some others.
  void within(const Vec3& c, double reach, std::vector<int>& found) const;

  /// The closest point to c, of several the one on the first triangle. Nothing when it is
  /// farther than `reach` [m].
  /// @param x, triangles those that the object was made of
  std::optional<NearestOnSurface> nearest(const std::vector<Vec3>& x,
                                          const std::vector<Triangle>& triangles,
                                          const Vec3& c, double reach) const;

private:
  /// A leaf has the triangles [first, end) of order_; another node has two children, of which
  /// the first one follows it.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t first = 0, end = 0;
    std::size_t second = 0; ///< number of the second child; 0 for a leaf
  };

  void build(const std::vector<Eigen::AlignedBox3d>& boxes,
             const std::vector<Vec3>& middles, std::size_t first, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<int> order_; ///< of the triangles
};

} // namespace mergel::dem
