/// The walls of an assembly as arrays of a state: their positions, and the histories of
/// their contacts and bonds. Forces on them are saved with the exact sums
/// (assembly_state.h).
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/state/state_file.h"

namespace mergel::dem {

/// Each rank saves the histories of its own particles.
void save_walls(State& state, const Assembly& assembly);

/// @throws InputError when the state has another number of walls of a kind
void check_walls(const State& state, const Assembly& assembly);

/// Load all histories, in ascending order. @pre check_walls(state, assembly)
/// @param n number of particles
/// @throws InputError when the arrays do not fit each other or the assembly
void load_walls(const State& state, std::size_t n, Assembly& assembly);

} // namespace mergel::dem
