/// Specimens: grain sizes, a cloud of grains grown into a region, and which of them are
/// bonded.
#pragma once

#include "dem/bonds.h"
#include "dem/neighbours.h"

#include <functional>

namespace mergel::dem {

/// Upright half cylinder, y >= 0, top at z = 0. Its side is the prism of `segments` equal
/// chords of the circle, as the wall triangles of a far-field mesh make it.
struct HalfCylinder {
  double radius = 0.0; ///< of the circle through the corners [m]
  double height = 0.0; ///< [m]
  int segments = 0;    ///< over the half circle

  double volume() const; ///< of the prism [m^3]
  /// Distance of x to the side, inside positive [m]; where two chords meet the nearer
  /// counts.
  double side_clearance(const Vec3& x) const;
  Vec3 side_normal(const Vec3& x) const; ///< of the chord nearest to x, inwards, unit
};

/// Upscaling ratio that grows with the distance from the pile's axis: S_inner for r <=
/// r_inner, linear to S_outer at r_outer, constant beyond.
struct GradedScale {
  double S_inner = 1.0, S_outer = 1.0; ///< [-], > 0
  double r_inner = 0.0, r_outer = 0.0; ///< [m]

  double at(double r) const;
};

/// What a specimen is made of and how.
struct SpecimenSpec {
  HalfCylinder region;
  GradedScale scale;
  double d_min = 0.0;        ///< smallest diameter at S = 1, d00 [m]
  double d_max = 0.0;        ///< largest diameter at S = 1; uniform in number between [m]
  double rho = 0.0;          ///< density of the grains [kg/m^3]
  double porosity = 0.0;     ///< target of the core [-], by true sphere volumes; see pack()
  double g_a = 0.0;          ///< activation gap at S = 1 [m]
  double coordination = 0.0; ///< target Z = 2 N_bonds/N [-]
  double g_b = 0.0;          ///< largest bonded gap at S = 1 [m]
  std::uint64_t seed = 1;

  /// @throws InputError when out of range, or for a porosity that these spheres cannot
  ///   reach
  void check() const;
};

/// Number of grains if all had the smaller upscaling ratio [-]: a bound.
double most_grains(const SpecimenSpec& spec);

/// Bound of most_grains(): indices hold 32 bits, and such a run fills a large machine.
inline constexpr double grains_limit = 2e7;

/// Volume fraction of the spheres with their far-field shell, radius R + g_a S/2, at the
/// target porosity. Growth finds room for it up to random close packing.
double effective_solid_fraction(const SpecimenSpec& spec);

/// Porosity further from every wall than one largest diameter [-]: the share of a grid's
/// points, a tenth of the smallest diameter apart at most, that lie in no sphere. A wall
/// orders the grains beside it and leaves voids there, so the porosity of the whole region
/// says little of the rock.
double core_porosity(const SpecimenSpec& spec, const Particles& p);

/// Grains in the region, with no far-field contact closed by more than `overlap` of the
/// pair's distance.
struct Packing {
  Particles particles;
  double porosity = 0.0;       ///< of the core [-]
  double whole_porosity = 0.0; ///< of the whole region [-]
  double overlap = 0.0;        ///< largest, far-field shell included, over distance [-]
};

/// Draw grains and grow them, with as much solid as gives the core its porosity within
/// 0.004.
///
/// Births per volume go as S^-3; S is frozen at birth; ids ascend along a space-filling
/// curve. Growth is overdamped, from 0.6 to 1 of the radii with their far-field shell,
/// without friction, so the packing is unjammed: at n = 0.52 and g_a = 0.15 d00 the shells
/// fill 0.626, just under random close packing. `progress` gets a fraction of the work.
/// @throws InputError when the core cannot be given its porosity, or only with overlaps
///   beyond 1e-3 of the distance
Packing pack(const SpecimenSpec& spec, const std::function<void(double)>& progress);

/// The bonds of a specimen and the gap they reached.
struct Bonding {
  std::vector<Pair> pairs; ///< ascending
  double limit = 0.0;      ///< largest bonded gap/S [m]
};

/// Pairs in ascending gap/S, ties by id, until 2 N_bonds/N = coordination or the gap
/// exceeds g_b S.
Bonding choose_bonds(const SpecimenSpec& spec, const Particles& p,
                     const PeriodicCell& cell);

/// What was reached.
struct SpecimenReport {
  std::size_t n_particles = 0, n_bonds = 0;
  double coordination = 0.0; ///< 2 N_bonds/N
  double largest_gap = 0.0;  ///< bonded, over S [m]
  double effective_fraction = 0.0;
  double S_min = 0.0, S_max = 0.0, d_min = 0.0, d_max = 0.0;
};
SpecimenReport describe(const SpecimenSpec& spec, const Particles& p,
                        const Bonding& bonding);

} // namespace mergel::dem
