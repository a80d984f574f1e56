/// Grains of a rock, and what is between them, as arrays of a state. Each rank puts its
/// share; what is taken is whole, in ascending order.
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/state/state_file.h"

namespace mergel::dem {

void put_grains(State& state, const Particles& p);
/// @throws InputError when some are missing, or have no size or mass
Particles take_grains(const State& state);

/// Bonds with their histories, broken ones too.
void put_bonds(State& state, const Particles& p, const Bonds& bonds);
/// @param n grains there are, here and below
/// @throws InputError when a pair is none of them, or is named twice, as below
Bonds take_bonds(const State& state, std::size_t n);

/// Contacts that have a history.
void put_contacts(State& state, const Particles& p, const Contacts& contacts);
Contacts take_contacts(const State& state, std::size_t n);

/// Breakages not yet taken.
void put_breakages(State& state, const PairLosses& losses);
/// In the order of the ranks that put them; a pair may be named twice.
std::vector<Breakage> take_breakages(const State& state, std::size_t n);

} // namespace mergel::dem
