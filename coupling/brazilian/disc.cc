#include "coupling/brazilian/disc.h"

#include <algorithm>
#include <cmath>

namespace mergel::coupling {

using dem::Vec3;

void lay_disc(dem::Particles& particles, const DiscGeometry& disc)
{
  for (dem::ParticleState& b : particles.state)
    b.x = Vec3(b.x.y(), b.x.z() + 0.5 * disc.thickness, b.x.x());
}

namespace {

/// At one point of the plane. A line load P at the rim sends radial compression
/// 2 P cos(theta)/(pi t r) into a half plane, theta from the loaded diameter.
PlaneStress stress_at(const DiscGeometry& disc, double P, double x, double z)
{
  const double R = disc.radius();
  const double tension = disc.splitting_stress(P);
  PlaneStress s{tension, tension};
  for (const double h : {R - z, R + z}) { // depth below each load, > 0
    const double r2 = x * x + h * h;
    const double factor = 2.0 * P / (dem::pi * disc.thickness) * h / (r2 * r2);
    s.xx -= factor * x * x;
    s.zz -= factor * h * h;
  }
  return s;
}

} // namespace

PlaneStress elastic_stress(const DiscGeometry& disc, double P, double half_width)
{
  constexpr int n = 40; // midpoints along a half edge: exact to 1e-4 at half_width = R/2
  PlaneStress sum;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = half_width * (i + 0.5) / n, z = half_width * (k + 0.5) / n;
      const PlaneStress s = stress_at(disc, P, x, z);
      sum.xx += s.xx / (n * n);
      sum.zz += s.zz / (n * n);
    }
  return sum;
}

DiscZone zone_of(const Vec3& x, const DiscGeometry& disc)
{
  const double D = disc.diameter, across = std::abs(x.x()), along = std::abs(x.z());
  if (along >= D / 3.0) return DiscZone::plates;
  if (across > D / 6.0) return DiscZone::sides;
  return along <= D / 6.0 ? DiscZone::centre : DiscZone::split;
}

std::array<std::size_t, n_disc_zones> count_zones(const std::vector<DiscBreak>& breaks,
                                                  std::size_t n, const DiscGeometry& disc)
{
  std::array<std::size_t, n_disc_zones> counts{};
  for (std::size_t k = 0; k < std::min(n, breaks.size()); ++k)
    ++counts[static_cast<std::size_t>(zone_of(breaks[k].x, disc))];
  return counts;
}

DiscZone where_it_began(const std::vector<DiscBreak>& breaks, std::size_t n,
                        const DiscGeometry& disc)
{
  const auto counts = count_zones(breaks, n, disc);
  return static_cast<DiscZone>(std::max_element(counts.begin(), counts.end()) -
                               counts.begin());
}

double share_near_diameter(const std::vector<DiscBreak>& breaks, std::size_t n,
                           const DiscGeometry& disc)
{
  const std::size_t all = std::min(n, breaks.size());
  if (all == 0) return 0.0;
  const auto near = std::count_if(
      breaks.begin(), breaks.begin() + static_cast<std::ptrdiff_t>(all),
      [&](const DiscBreak& b) { return std::abs(b.x.x()) <= disc.diameter / 6.0; });
  return static_cast<double>(near) / static_cast<double>(all);
}

} // namespace mergel::coupling
