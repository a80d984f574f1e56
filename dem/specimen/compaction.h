/// Specimens under pressure: a grown cloud settles as a rock without bonds, with inertia,
/// friction and far-field contacts, inside its periodic box or between its walls.
///
/// Walls are smooth planes of the grains' own stiffness, without a far-field shell; the cut
/// of a half cylinder is a mirror. Shear at rest is forgotten: what is kept are places and
/// sizes, and a contact's normal force, hence the pressure, follows from these alone.
#pragma once

#include "dem/assembly/step.h"
#include "dem/specimen/packing.h"

namespace mergel::dem {

/// Mean normal stress of what touches in the rock, compression positive [Pa]:
/// p = sum f_n l / (3 V), l the distance of two centres, or of a centre and the wall. Shear
/// acts across l and adds nothing. Collective.
double mean_pressure(const Rock& rock, double volume);

/// Meet porosity and pressure together.
///
/// For a given friction the sizes grow from well below the target until the grains bear the
/// pressure at rest; the more friction, the looser they lock. Friction is bisected until they
/// lock at the target porosity. Sizes differ from the wanted ones by the rest, 1e-3 at most
/// as a rule: a periodic box takes it over, inside walls the grains keep it.
/// @throws InputError with the porosities that lock at least and most friction, when the
///   target lies outside
/// @throws CollectiveFailure when the grains do not come to rest
void confine(const SpecimenSpec& spec, Packing& packing, MPI_Comm comm,
             const std::function<void(double)>& progress);

/// Let the grains at their full sizes come to rest, whatever pressure they bear.
/// @throws CollectiveFailure when they do not
void expand(const SpecimenSpec& spec, Packing& packing, MPI_Comm comm,
            const std::function<void(double)>& progress);

/// What the list of a settling rock holds beside its skin, over the smallest grain: room for
/// sizes to grow before it is made anew.
inline constexpr double growth_reserve = 0.1;

/// Porosity and pressure that count as met.
inline constexpr double porosity_tolerance = 0.005;
inline constexpr double pressure_tolerance = 0.2; // of the pressure

} // namespace mergel::dem
