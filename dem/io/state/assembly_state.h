/// The state of a rock as named arrays: what must be kept for it to go on with the same
/// bits.
///
/// Kept: motion, loads and living bonds of every grain; every bond with its history, broken
/// ones too; the shear of touching contacts; histories at mirror, planes, walls and pile;
/// place and velocity of planes, wall nodes and pile; the exact sums of forces on them, of
/// losses and works; counts of broken and yielded bonds, and breakages not yet taken.
///
/// Not kept: what the case says (materials, strengths of grains, gravity, topology of walls)
/// and what a list holds without acting: an open contact has no history, and lists are made
/// anew. Wall-clock times.
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/state/state_file.h"

namespace mergel::dem {

/// Add the rock to a state; each rank its share. Collective.
void put(State& state, const Rock& rock);

/// Put the kept state into a rock that has the walls, planes, mirrors and piles of its
/// case. The rock is then whole: every rank has all of it, in ascending order. The arrays of
/// grains, bonds and contacts are freed on the way: a rank need not hold all of it twice.
/// @throws InputError when the arrays do not fit each other or the rock
void take(State& state, Rock& rock);

/// Exact sums as whole numbers, words of 64 bits, the lowest first.
void put_sums(State& state, const std::string& name, const std::vector<ExactWide*>& sums);
void take_sums(const State& state, const std::string& name,
               const std::vector<ExactWide*>& sums);

} // namespace mergel::dem
