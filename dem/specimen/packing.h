/// Specimens: a cloud of grains grown into a region until it has its porosity, and the
/// pressure that is wanted with it.
#pragma once

#include "dem/laws/linear.h"
#include "dem/particles/particles.h"
#include "dem/specimen/psd.h"
#include "dem/specimen/region.h"

#include <functional>
#include <mpi.h>

namespace mergel::dem {

/// Upscaling ratio that grows with the distance from the axis: S_inner for r <= r_inner,
/// linear to S_outer at r_outer, constant beyond. Equal ratios: the same everywhere.
struct GradedScale {
  double S_inner = 1.0, S_outer = 1.0; ///< [-], > 0
  double r_inner = 0.0, r_outer = 0.0; ///< [m]

  double at(double r) const;
};

/// How grains bear each other at the target porosity.
enum class Compaction {
  unjammed, ///< no far-field shell is closed: no pressure
  confined, ///< a pressure is met together with the porosity
  expanded  ///< the porosity is met, whatever the pressure: radii expansion, Potyondy and
            ///< Cundall (2004), Int. J. Rock Mech. Min. Sci. 41, 1329
};

/// What a specimen is made of and how.
struct SpecimenSpec {
  Region region;
  Grading sizes; ///< at S = 1
  GradedScale scale;
  double rho = 0.0;       ///< density of the grains [kg/m^3]
  double porosity = 0.0;  ///< target of the core [-], by true sphere volumes; see pack()
  LinearMaterial contact; ///< far-field contact; its activation gap takes room in all modes
  Compaction compaction = Compaction::unjammed;
  double pressure = 0.0;      ///< confined: wanted [Pa], > 0
  double friction = 0.0;      ///< expanded: between grains while they grow [-], >= 0
  bool free_rotation = false; ///< of unbonded grains while they settle
  double coordination = 0.0;  ///< target Z = 2 N_bonds/N [-]
  double g_b = 0.0;           ///< largest bonded gap at S = 1 [m]
  std::uint64_t seed = 1;

  /// @throws InputError when out of range, or for a porosity that these spheres cannot
  ///   reach
  void check() const;
};

/// Number of grains if all had the smaller upscaling ratio [-]: a bound.
double most_grains(const SpecimenSpec& spec);

/// Bound of most_grains(): indices hold 32 bits, and such a run fills a large machine.
inline constexpr double grains_limit = 2e7;

/// Least width of the region that its largest grain needs [m]: twice its diameter, and in a
/// periodic box room for the gaps that are looked for, lest it meet its own image.
double width_needed(const SpecimenSpec& spec);

/// Volume fraction of the spheres with their far-field shell, radius R + g_a S/2, at the
/// target porosity. Growth finds room for it up to random close packing.
double effective_solid_fraction(const SpecimenSpec& spec);

/// Grains in the region.
struct Packing {
  Particles particles;
  PeriodicCell cell;           ///< of a periodic box, as made
  double porosity = 0.0;       ///< of the core [-]
  double whole_porosity = 0.0; ///< of the whole region [-]
  double overlap = 0.0;        ///< largest, far-field shell included, over distance [-]
  double pressure = 0.0;       ///< mean of the far-field contacts and walls [Pa]
  double friction = 0.0;       ///< between grains while the packing was made [-]
};

/// Fill in both porosities, of the box as made.
void measure_porosity(const SpecimenSpec& spec, Packing& packing);

/// Draw grains and grow them, with as much solid as gives the core its porosity within
/// 0.004. The same spec gives the same bits, on any number of ranks.
///
/// Births per volume go as S^-3; S is frozen at birth; ids ascend along a space-filling
/// curve. Growth is overdamped, from 0.6 to 1 of the radii with their far-field shell,
/// without friction: at n = 0.52 and g_a = 0.15 d00 the shells fill 0.626, just under random
/// close packing, and the packing is unjammed. Confined and expanded packings then settle
/// with friction (settle.h).
/// @param progress gets a fraction of the work
/// @param comm ranks that share the settling; MPI_COMM_NULL for this one alone, which needs
///   no MPI
/// @throws InputError when the core cannot be given its porosity, unjammed only with overlaps
///   beyond 1e-3 of the distance, or confined not with this pressure
Packing pack(const SpecimenSpec& spec, const std::function<void(double)>& progress,
             MPI_Comm comm = MPI_COMM_NULL);

/// Sizes of the grains as made, over their S, beside the grading that was asked for.
struct SizeReport {
  double d_10 = 0.0, d_50 = 0.0, d_90 = 0.0; ///< by mass [m]
  double distance_by_number = 0.0; ///< Kolmogorov's, largest difference of the shares [-]
  double distance_by_mass = 0.0;   ///< the same of the shares by mass [-]
};
SizeReport describe_sizes(const Grading& wanted, const Particles& p);

/// Extremes of what was made.
struct GrainRange {
  double S_min = 0.0, S_max = 0.0;
  double d_min = 0.0, d_max = 0.0; ///< [m]
};
GrainRange describe_grains(const Particles& p);

} // namespace mergel::dem
