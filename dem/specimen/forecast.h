/// What a recipe will make, before it is made: number of particles and time step.
#pragma once

#include "dem/pairs/forces.h"
#include "dem/specimen/packing.h"

namespace mergel::dem {

/// Contacts of a particle in a packing without bonds at rest, for estimates [-].
inline constexpr double granular_coordination = 4.5;

/// Number of particles that are drawn for this recipe, on average [-]: solid volume over mean
/// volume of a particle, both with S as it varies over the region. Packing corrects it by some
/// percent, because walls keep particles off.
double expected_particles(const SpecimenSpec& spec);

/// Estimate of the stable step of the particles [s], within some 20 % (tests/unit/dem/forecast.cc):
/// that of the smallest particle in a shell of `coordination` neighbours of mean size, bonded and
/// in far-field contact, its springs in all directions alike.
/// @param coordination 0: granular, contacts alone
/// @param inertia_factor of the moments of inertia [-]
double estimated_stable_step(const SpecimenSpec& spec, const PairMaterials& material,
                             double inertia_factor = 1.0);

} // namespace mergel::dem
