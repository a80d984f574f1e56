/// The stress around each particle of an assembly that is no periodic cell.
#pragma once

#include "dem/continuum/loaded_branches.h"

namespace mergel::dem {

/// Symmetric part of Love's sum F (x) (x_c - x_i) over the branches of a particle and of its
/// neighbours, divided by their volumes v/(1 - n), v the sphere volume [Pa], tension positive.
/// Neighbours are those within neighbour_reach (local_strain.h) now: the averaging length is some
/// three diameters of the particle itself. Branches to walls and images are included. Not
/// collective.
/// @param porosity n of the rock around each particle [-], below 1
std::vector<Mat3> neighbourhood_stresses(const Particles& p,
                                         const std::vector<LoadedBranch>& branches,
                                         const std::vector<double>& porosity);

} // namespace mergel::dem
