#include "dem/walls/revolution.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

Revolution cone_ended(double R, double height)
{
  return {{{0.0, 0.0}, {R, height}}};
}

Revolution flat_ended(double R)
{
  return {{{0.0, 0.0}, {R, 0.0}}};
}

void Revolution::check() const
{
  require(profile.size() >= 2 && profile.front().r == 0.0 && profile.front().z == 0.0,
          "the profile of a body of revolution must begin at (0, 0) and have two corners");
  Corner before{1.0, 0.0}; // direction of the last piece: at first horizontal
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const Corner along{profile[k].r - profile[k - 1].r, profile[k].z - profile[k - 1].z};
    require(along.r > 0.0 && along.z >= 0.0,
            "the profile of a body of revolution must run outwards and upwards");
    require(before.r * along.z >= along.r * before.z,
            "the profile of a body of revolution must be convex");
    before = along;
  }
}

namespace {

/// Whether the point at (r, z) lies inside the profile.
bool is_inside(const std::vector<Revolution::Corner>& profile, double r, double z)
{
  if (z <= 0.0) return false;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const auto &a = profile[k - 1], &b = profile[k];
    if (z < b.z) return (r - a.r) * (b.z - a.z) < (b.r - a.r) * (z - a.z);
  }
  return r < profile.back().r;
}

} // namespace

bool Revolution::is_beyond(const ParticleState& b, const Vec3& x, double gap) const
{
  const double dx = b.x.x() - x.x(), dy = b.x.y() - x.y();
  const double reach = b.R + gap, around = R() + reach;
  return dx * dx + dy * dy > around * around || x.z() - b.x.z() > reach;
}

SurfacePoint Revolution::closest_point(const ParticleState& b, const Vec3& x) const
{
  const double dx = b.x.x() - x.x(), dy = b.x.y() - x.y();
  const double r = std::sqrt(dx * dx + dy * dy), z = b.x.z() - x.z();
  // Radial unit vector; on the axis any direction does, because the lowest point is closest.
  const Vec3 e_r = r > 0.0 ? Vec3(dx / r, dy / r, 0.0) : Vec3(1.0, 0.0, 0.0);
  if (is_inside(profile, r, z))
    throw NumericalError(
        "its centre is inside a rigid wall, at r = " + std::to_string(r) + " m, " +
        std::to_string(z) +
        " m above the tip; the contact of the wall is too soft or the time "
        "step too long");

  // By convexity the closest point lies on the first piece whose end is not passed.
  SurfacePoint closest;
  Corner foot{R(), std::max(tip_height(), z)};
  closest.part = z > tip_height() ? shaft : tip;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const Corner &from = profile[k - 1],
                 along{profile[k].r - from.r, profile[k].z - from.z};
    const double t = ((r - from.r) * along.r + (z - from.z) * along.z) /
                     (along.r * along.r + along.z * along.z);
    if (t > 1.0) continue;
    foot = {from.r + std::max(0.0, t) * along.r, from.z + std::max(0.0, t) * along.z};
    closest.part = tip;
    break;
  }
  const double dr = foot.r - r, dz = foot.z - z, d = std::sqrt(dr * dr + dz * dz);
  if (!(d > 0.0)) throw NumericalError("its centre lies on the surface of a rigid wall");
  closest.n = (dr * e_r + dz * Vec3::UnitZ()) / d;
  closest.gap = d - b.R;
  closest.point = b.x + d * closest.n;
  return closest;
}

} // namespace mergel::dem
