/// Which particles are neighbours (local_strain.h).
#pragma once

#include "dem/assembly/local_strain.h"
#include "dem/pairs/pairs.h"

namespace mergel::dem {

/// Pairs with |x_j - x_i| < neighbour_reach (R_i + R_j), each once, ascending.
/// @param x positions [m], never wrapped; @param R radii [m], > 0
/// @throws InputError when a periodic edge is shorter than 4 neighbour_reach times the largest
///   radius
std::vector<Pair> neighbours(const std::vector<Vec3>& x, const std::vector<double>& R,
                             const PeriodicCell& cell = {});

/// Those pairs with an owned particle; the positions of all particles are up to date.
/// @param X positions instead of the present ones [m]; empty: these
std::vector<Pair> neighbours(const Particles& p, const PeriodicCell& cell = {},
                             const std::vector<Vec3>& X = {});

/// Whether neighbours() finds each pair once: in a periodic cell that is narrower than the
/// neighbourhood of its largest particle a particle would have neighbours twice, or itself.
bool holds_neighbourhoods(const PeriodicCell& cell, const Particles& p);

/// neighbours() where the cell holds neighbourhoods, else none.
std::vector<Pair> held_neighbours(const Particles& p, const PeriodicCell& cell = {});

/// Velocity gradients (local_strain.h) of the owned particles, in their order; the velocities of
/// all particles are up to date.
/// @param pairs of held_neighbours()
std::vector<Mat3> velocity_gradients(const Particles& p, const PeriodicCell& cell,
                                     const std::vector<Pair>& pairs);

} // namespace mergel::dem
