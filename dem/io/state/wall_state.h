/// Mirrors, planes, walls and piles of a rock as arrays of a state: their places, and their
/// histories with grains. Forces on them are exact sums (rock_state.h).
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/state/state_file.h"

namespace mergel::dem {

/// Each rank puts the histories of its grains.
void put_walls(State& state, const Rock& rock);

/// @throws InputError when the state counts other mirrors, planes, walls or piles
void check_walls(const State& state, const Rock& rock);

/// Whole, in ascending order. @pre check_walls(state, rock)
/// @param n grains there are
/// @throws InputError when the arrays do not fit each other or the rock
void take_walls(const State& state, std::size_t n, Rock& rock);

} // namespace mergel::dem
