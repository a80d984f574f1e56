/// Masses other than the true ones: for a longer time step, and for settling (dem/README.md,
/// Mass scaling).
#pragma once

#include "dem/assembly/assembly.h"
#include "dem/assembly/springs.h"

#include <string>

namespace mergel::dem {

struct MassScalingSpec {
  double gain = 1.0;           ///< wanted gain of the time step [-], >= 1; 1: no scaling
  double largest_share = 0.05; ///< of the mass that a zone may gain [-], >= 0
};

/// What was scaled in the particles of one zone of the specimen.
struct ScaledZone {
  double S_from = 0.0, S_to = 0.0; ///< its upscaling ratios [-]
  std::size_t n = 0, n_scaled = 0; ///< particles
  double mass = 0.0, added = 0.0;  ///< [kg]

  double share() const { return mass > 0.0 ? added / mass : 0.0; } ///< [-]
};

/// Mass and moment of inertia of each particle whose block bound is below `gain` times the
/// smallest one are multiplied, by the same factor, so that it is that. Gravity acts on the
/// true mass. Zones of the specimen: the particles of the smallest S, those of the largest
/// S, and those between; one zone where S is uniform.
///
/// A quasi-static result does not depend on the masses. Equal masses are accepted practice
/// for cone penetration (Falagush, McDowell, Yu and de Bono 2015, Granular Matter 17, 141).
/// Once for an assembly with its bonds, before its first step; collective.
/// @throws InputError when a zone would gain more than spec.largest_share of its mass
void scale_masses(Assembly& assembly, const MassScalingSpec& spec);

/// For settling: mass and moment of inertia of each particle are such that its block bound is
/// omega2 [1/s^2], so that all parts of the assembly come to rest at the same pace. Nothing
/// but the equilibrium is meant to be used. Particles without springs keep their mass.
/// Gravity acts on the true mass. Collective.
void equalise_frequencies(Assembly& assembly, const Springs& springs, double omega2);

/// Give the particles their true masses again, without any scaling. They are at rest then.
void restore_masses(Assembly& assembly);

/// What the particles have gained by it; empty without mass scaling.
std::vector<ScaledZone> scaled_zones(const Particles& p);
/// All zones as one.
ScaledZone sum_of(const std::vector<ScaledZone>& zones);

/// A line for each zone, and for all.
std::string report(const std::vector<ScaledZone>& zones);

} // namespace mergel::dem
