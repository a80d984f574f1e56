/// A body of revolution about a vertical axis: a shaft with a tip of any convex profile.
#pragma once

#include "dem/walls/wall_contact.h"

#include <array>
#include <vector>

namespace mergel::dem {

/// The profile runs from the lowest point of the axis over its corners, outwards and
/// upwards, and goes on as a vertical shaft without end. It is convex, so the closest point
/// to a centre outside is unique. The wall's x is the lowest point of the axis.
struct Revolution {
  static constexpr std::array parts{"tip", "shaft"};
  enum Part : std::size_t { tip, shaft };

  /// A corner of the profile, relative to the wall's x [m].
  struct Corner {
    double r = 0.0, z = 0.0;
  };
  std::vector<Corner> profile{{0.0, 0.0}, {0.0, 0.0}}; ///< the first one at (0, 0)

  double R() const { return profile.back().r; }          ///< of the shaft [m]
  double tip_height() const { return profile.back().z; } ///< of the shaft's lower end [m]

  /// @throws InputError for a profile that does not start at (0, 0), falls, turns inwards
  ///   or is not convex
  void check() const;

  /// Quick test of a gap larger than `gap` [m]; it may fail to tell.
  bool is_beyond(const ParticleState& b, const Vec3& x, double gap) const;
  /// The edge of the shoulder counts as tip.
  /// @throws NumericalError for a centre inside the wall
  SurfacePoint closest_point(const ParticleState& b, const Vec3& x) const;
};

/// @param R radius of the shaft [m], > 0; @param height of the cone [m], R / tan(half its
///   angle), > 0
Revolution cone_ended(double R, double height);
Revolution flat_ended(double R);

} // namespace mergel::dem
