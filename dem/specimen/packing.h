/// Packings: particles grow in a region until the packing has the target porosity and, if
/// confined, the target pressure (dem/README.md, Specimens).
#pragma once

#include "dem/laws/contact_law.h"
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

/// State of the packing at the target porosity.
enum class Compaction {
  unjammed, ///< no far-field contact is active: no pressure
  confined, ///< under a target pressure
  expanded  ///< under the pressure that results: radius expansion, Potyondy and Cundall
            ///< (2004), Int. J. Rock Mech. Min. Sci. 41, 1329
};

/// Recipe of a specimen.
struct SpecimenSpec {
  Region region;
  Grading sizes; ///< at S = 1
  GradedScale scale;
  double rho = 0.0;      ///< density of the grains [kg/m^3]
  double porosity = 0.0; ///< target of the core [-], by sphere volumes; see pack()
  ContactLaw contact;    ///< all modes pack the shells of its activation gap
  Compaction compaction = Compaction::unjammed;
  double pressure = 0.0;      ///< confined: target [Pa], > 0
  double friction = 0.0;      ///< expanded: between particles while they settle [-], >= 0
  bool free_rotation = false; ///< of unbonded particles while they settle
  double coordination = 0.0;  ///< target Z = 2 N_bonds/N [-]
  double g_b = 0.0;           ///< largest bonded gap at S = 1 [m]
  std::uint64_t seed = 1;

  /// @throws InputError for a value out of range, or a porosity that these particles cannot
  ///   reach
  void check() const;
};

/// Number of particles if all had the smaller upscaling ratio [-]: a bound.
double max_particles(const SpecimenSpec& spec);

/// Limit of max_particles(): an index has 32 bits, and such a run fills a large machine.
inline constexpr double particles_limit = 2e7;

/// A specimen of fewer has no contact and no size curve.
inline constexpr std::size_t fewest_particles = 2;

/// Smallest width of the region [m]: twice the diameter of the largest particle. A periodic
/// box must also be wide enough for the search range, so that no particle is paired with
/// its own image.
double width_needed(const SpecimenSpec& spec);

/// Volume fraction of the particles with their far-field shells, radius R + g_a S/2, at the
/// target porosity. Growth reaches it without pressure up to random close packing.
double effective_solid_fraction(const SpecimenSpec& spec);

/// Particles in the region.
struct Packing {
  Particles particles;
  PeriodicCell cell;           ///< of a periodic box, as made
  double porosity = 0.0;       ///< of the core [-]
  double whole_porosity = 0.0; ///< of the whole region [-]
  double overlap = 0.0;        ///< largest, far-field shell included, over distance [-]
  double pressure = 0.0;       ///< mean of the far-field contacts and walls [Pa]
  double friction = 0.0;       ///< between particles while the packing was made [-]
};

/// Fill in both porosities, of the box as made.
void measure_porosity(const SpecimenSpec& spec, Packing& packing);

/// Draw particles and grow them. The solid volume is corrected until the core has its
/// porosity within 0.004. The same spec gives the same bits, on any number of ranks.
///
/// The number of particles drawn per volume is proportional to S^-3; S is that of the place
/// where a particle is drawn; ids ascend along a space-filling curve. Growth is overdamped
/// and without friction, from 0.6 to 1 of the radii with their far-field shells. At n =
/// 0.52 and g_a = 0.15 d00 the particles with shells fill 0.626, just below random close
/// packing, and the packing is unjammed. Confined and expanded packings then settle with
/// friction (dem/specimen/compaction.h).
/// @param progress gets a fraction of the work
/// @param comm ranks that share growth and settling; MPI_COMM_NULL for one rank without MPI
/// @throws InputError when the core cannot reach its porosity: unjammed, when overlaps
///   above 1e-3 of the distance remain; confined, when not together with the pressure; any,
///   when fewer than two particles are drawn
Packing pack(const SpecimenSpec& spec, const std::function<void(double)>& progress,
             MPI_Comm comm = MPI_COMM_NULL);

/// Sizes of the particles at S = 1, compared with the wanted grading.
struct SizeReport {
  double d_10 = 0.0, d_50 = 0.0, d_90 = 0.0; ///< by mass [m]
  double distance_by_number = 0.0; ///< Kolmogorov: largest difference of the shares [-]
  double distance_by_mass = 0.0;   ///< the same of the shares by mass [-]
};
SizeReport describe_sizes(const Grading& wanted, const Particles& p);

/// Smallest and largest S and diameter of the particles.
struct ParticleRange {
  double S_min = 0.0, S_max = 0.0;
  double d_min = 0.0, d_max = 0.0; ///< [m]
};
ParticleRange describe_particles(const Particles& p);

} // namespace mergel::dem
