/// The stress around each particle of an assembly, and the porosity that its volume needs.
#pragma once

#include "dem/assembly/local_strain.h"
#include "dem/continuum/loaded_branches.h"

namespace mergel::dem {

/// The stress around each owned particle, in their order: symmetric part of Love's sum
/// F (x) (x_c - x_i) over the branches of a particle and of its neighbours, divided by their
/// volumes v/(1 - n), v the sphere volume [Pa], tension positive. Neighbours are those within
/// neighbour_reach (local_strain.h) now: the averaging length is some three diameters of the
/// particle itself. Branches to walls and images are included. In a periodic
/// cell too narrow for neighbourhoods (assembly/neighbourhood.h) each particle has the stress of
/// the cell. The positions of all particles are up to date. Collective.
/// @param branches of loaded_branches()
/// @param porosity n of the rock around each owned particle [-], below 1
/// @param pairs of held_neighbours() (neighbourhood.h)
std::vector<Mat3> neighbourhood_stresses(const Assembly& assembly,
                                         const std::vector<LoadedBranch>& branches,
                                         const std::vector<double>& porosity,
                                         const std::vector<Pair>& pairs);

/// The porosity of a specimen as that around each owned particle [-].
/// @param volume of the specimen [m^3], above 0
std::vector<double> even_porosity(const Particles& p, double volume);

/// The porosity around each particle after local strains, 1 - (1 - n_0)/det F, between 0 and
/// 1 - smallest_solid [-].
/// @param n_0 porosity of the specimen before [-]
std::vector<double> strained_porosity(double n_0, const std::vector<DeformationFit>& fits);

} // namespace mergel::dem
