/// The state of an assembly as named arrays: all that a run needs to resume with the same
/// bits (dem/README.md, Parallel execution).
///
/// Saved: motion, loads and number of intact bonds of each particle; every bond with its
/// history, broken bonds too; shear forces of contacts; histories at all walls; position
/// and velocity of rigid walls and wall nodes; exact sums of the forces on them, of losses
/// and works; numbers of broken and yielded bonds; breakages not yet written out.
///
/// Not saved: what the case determines (materials, strengths of particles, gravity,
/// shapes and topology of walls); open contacts, which have no history; lists, which are rebuilt;
/// wall-clock times.
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/state/state_file.h"

namespace mergel::dem {

/// Add the assembly to a state, each rank its own part. Collective.
void save(State& state, const Assembly& assembly);

/// Load a state into an assembly that has the walls of its case.
/// The assembly is then a gathered one: every rank has all of it, in ascending order. The
/// arrays of particles, bonds and contacts are freed meanwhile, so that a rank does not
/// hold them twice.
/// @throws InputError when the arrays do not fit each other or the assembly
void load(State& state, Assembly& assembly);

} // namespace mergel::dem
