/// Specimens under pressure: a grown packing settles without bonds, with inertia, friction
/// and far-field contacts, in its periodic box or between its walls (dem/README.md,
/// Specimens).
///
/// Walls are smooth planes with the stiffness of the particles' contact, without a
/// far-field shell; the cut of a half cylinder is a mirror. Only positions and sizes are
/// kept: normal forces, and so the pressure, follow from them. Shear forces at rest are
/// dropped.
#pragma once

#include "dem/assembly/step.h"
#include "dem/specimen/packing.h"

namespace mergel::dem {

/// Mean normal stress of all contacts, compression positive [Pa]: p = sum f_n l / (3 V), l
/// the distance between two centres, or between a centre and the wall. Shear forces are
/// normal to l and add nothing. Collective.
double mean_pressure(const Assembly& assembly, double volume);

/// Reach the target porosity and the target pressure together.
///
/// For a given friction the particles grow from below their full size until they bear the
/// pressure at rest. The higher the friction, the higher the porosity at which they jam.
/// The friction is bisected until they jam at the target porosity. Their sizes then differ
/// from the wanted ones, usually by 1e-3 at most: a periodic box is scaled instead, between
/// walls the particles keep the change.
/// @throws InputError, naming the porosities of zero and full friction, when the target
///   lies outside of them
/// @throws CollectiveFailure when the particles do not come to rest
void confine(const SpecimenSpec& spec, Packing& packing, MPI_Comm comm,
             const std::function<void(double)>& progress);

/// Let the particles come to rest at full size, under the pressure that results.
/// @throws CollectiveFailure when they do not come to rest
void expand(const SpecimenSpec& spec, Packing& packing, MPI_Comm comm,
            const std::function<void(double)>& progress);

/// Extra range of the pair list of a settling packing, beside its skin, over the smallest
/// diameter [-]: sizes may grow by it before the list is rebuilt.
inline constexpr double growth_reserve = 0.1;

/// Tolerances of the target porosity [-] and of the target pressure.
inline constexpr double porosity_tolerance = 0.005;
inline constexpr double pressure_tolerance = 0.2; // over the target pressure

} // namespace mergel::dem
