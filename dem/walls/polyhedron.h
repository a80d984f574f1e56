/// A rigid body with a closed surface of triangles, as a pile of any shape.
#pragma once

#include "dem/walls/cross_sections.h"
#include "dem/walls/feature_numbers.h"
#include "dem/walls/patch_features.h"
#include "dem/walls/surface_search.h"

#include <array>
#include <vector>

namespace mergel::dem {

/// The wall's x is the point of the polyhedron's axis z at the height of its lowest point. All
/// of its surface is one patch (patch_features.h): at a ridge a particle has one contact, in a
/// corner each side acts. Features that a particle sees from behind, through the polyhedron, do
/// not act.
struct Polyhedron {
  static constexpr std::array parts{"tip", "shaft"};
  enum Part : std::size_t { tip, shaft };

  Wall surface;         ///< in the axes of the polyhedron; its nodes do not move
  SurfaceSearch search; ///< of this surface
  std::vector<SectionCircle> sections; ///< cross_sections()
  double tip_height = 0.0; ///< height up to which it is the tip [m], see largest()
  double length = 0.0;     ///< [m]
  double R_outside = 0.0;  ///< largest distance of a point from the axis [m]

  double R() const { return largest(sections).R; } ///< of the largest section's circle [m]
  ClosedSurface closed_surface() const { return {surface.x, surface.topology.triangles}; }
  std::size_t part_at(const Vec3& point) const ///< of a point in the axes of the polyhedron
  {
    return point.z() > tip_height + 1e-9 * length ? shaft : tip; // round-off
  }

  /// Quick test of a gap larger than `gap` [m]; it may fail to tell.
  bool is_beyond(const ParticleState& b, const Vec3& x, double gap) const;
  /// @throws NumericalError for a centre inside the polyhedron
  SurfacePoint closest_point(const ParticleState& b, const Vec3& x) const;
};

/// The surface is moved along z, so that its lowest point has z = 0.
/// @throws InputError as require_closed()
Polyhedron make_polyhedron(ClosedSurface surface);

/// @throws InputError naming the point whose mirror image in the plane y = 0 is farther than
///   `tolerance` [m] from the surface
void require_symmetric(const Polyhedron& polyhedron, double tolerance);

/// Finds the features of a polyhedron that are in contact, particle after particle.
class PolyhedronFeatures {
public:
  /// @param polyhedron must outlive the object
  explicit PolyhedronFeatures(const Polyhedron& polyhedron);

  /// Of all that lie within `reach` [m] of a centre x in the axes of the polyhedron; an overlap is
  /// reach - distance.
  /// @throws NumericalError for a centre inside the polyhedron
  const std::vector<PatchFeature>& find(const Vec3& x, double reach);

private:
  const Polyhedron& polyhedron_;
  FeatureNumbers numbers_;
  PatchFeatures features_;
  std::vector<int> triangles_;
  std::vector<NearTriangle> near_;
  std::vector<PatchFeature> found_;
};

} // namespace mergel::dem
