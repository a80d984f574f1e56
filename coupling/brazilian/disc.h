/// The disc of a Brazilian test: its frame, its elastic stress, and where it breaks.
///
/// Coordinates of the disc: y is its axis, z the direction of the load, x lies across; the
/// origin is its centre. The loaded diameter is the axis z.
#pragma once

#include "dem/laws/bond_section.h"
#include "dem/particles/particles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mergel::coupling {

struct DiscGeometry {
  double diameter = 0.0, thickness = 0.0; ///< [m], > 0

  double radius() const { return 0.5 * diameter; }
  double volume() const { return 0.25 * dem::pi * diameter * diameter * thickness; }
  /// 2 P/(pi D t): tension at the centre of an elastic disc under two line loads P [Pa].
  double splitting_stress(double P) const
  {
    return 2.0 * P / (dem::pi * diameter * thickness);
  }
};

/// The particles of a cylinder about the axis z with its top at z = 0, as specimens are
/// made, in the coordinates of the disc. The axes change places, no length changes a bit but
/// along y.
void lay_disc(dem::Particles& particles, const DiscGeometry& disc);

/// Stress in the plane of a disc [Pa], tension positive.
struct PlaneStress {
  double xx = 0.0, zz = 0.0;
};

/// Mean stress of an elastic disc over the square |x|, |z| <= half_width about its centre,
/// under two line loads P [N] that press at (0, +-R):
///
///   sigma = Flamant's fields of both loads + 2 P/(pi D t) on all directions
///
/// At the centre xx = 2 P/(pi D t) and zz = -6 P/(pi D t).
/// Source: Hertz (1883); Timoshenko and Goodier (1951), Theory of Elasticity, art. 37.
/// Hondros (1959), Aust. J. Appl. Sci. 10, 243, for loads over an arc.
/// @param half_width >= 0, below R/sqrt(2) [m]
PlaneStress elastic_stress(const DiscGeometry& disc, double P, double half_width);

/// Where a bond of a disc broke.
enum class DiscZone {
  centre, ///< within D/6 of the centre, along x and along z
  plates, ///< the outer sixths of the height: |z| >= D/3
  split,  ///< elsewhere within D/6 of the loaded diameter
  sides   ///< the rest
};
inline constexpr std::size_t n_disc_zones = 4;
DiscZone zone_of(const dem::Vec3& x, const DiscGeometry& disc);

/// A bond that broke.
struct DiscBreak {
  dem::Vec3 x = dem::Vec3::Zero(); ///< half way between the particles [m]
  dem::Vec3 n = dem::Vec3::Zero(); ///< unit, from the first particle to the second
  double radius = 0.0;             ///< the smaller one of the two particles [m]
  double to_plate = 0.0;           ///< distance to the nearer plate, then [m]
  double strain = 0.0;             ///< diametral, then [-]
  double load = 0.0;               ///< mean of both plates, then [N]
  std::uint64_t step = 0, first = 0, second = 0; ///< number of the step, of the particles
  dem::BreakMode mode = dem::BreakMode::tension;
};

/// Number of breaks in each zone among the first `n`.
std::array<std::size_t, n_disc_zones> count_zones(const std::vector<DiscBreak>& breaks,
                                                  std::size_t n, const DiscGeometry& disc);

/// The zone of most of the first `n` breaks; of equals the one that comes first above.
/// @pre there is a break
DiscZone where_it_began(const std::vector<DiscBreak>& breaks, std::size_t n,
                        const DiscGeometry& disc);

/// Share of the first `n` breaks within D/6 of the loaded diameter, |x| <= D/6; 0 without one.
double share_near_diameter(const std::vector<DiscBreak>& breaks, std::size_t n,
                           const DiscGeometry& disc);

} // namespace mergel::coupling
