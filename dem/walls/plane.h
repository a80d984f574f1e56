/// A plane that particles cannot pass.
#pragma once

#include "dem/walls/wall_contact.h"

#include <array>

namespace mergel::dem {

/// Half space; the particles are on the side to which `normal` points. The wall's x is any
/// point of the plane.
struct Plane {
  static constexpr std::array parts{"plane"};

  Vec3 normal = Vec3::UnitZ(); ///< unit, towards the particles

  /// Quick test of a gap larger than `gap` [m]; it may fail to tell.
  bool is_beyond(const ParticleState& b, const Vec3& x, double gap) const
  {
    return (b.x - x).dot(normal) - b.R > gap;
  }
  /// @throws NumericalError for a centre behind the plane
  SurfacePoint closest_point(const ParticleState& b, const Vec3& x) const
  {
    const double height = (b.x - x).dot(normal);
    if (height < 0.0)
      throw NumericalError("its centre is " + std::to_string(-height) +
                           " m behind a plane wall; the contact of the wall is too soft or "
                           "the time step too long");
    return {-normal, height - b.R, b.x - height * normal, 0};
  }
};

} // namespace mergel::dem
