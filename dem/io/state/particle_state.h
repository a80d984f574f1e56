/// Particles, bonds and contacts as arrays of a state. Each rank saves its own part; what
/// is loaded is complete, in ascending order.
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/state/state_file.h"

namespace mergel::dem {

void save_particles(State& state, const Particles& p);
/// @throws InputError when particles are missing, or have no size or mass
Particles load_particles(const State& state);

/// Bonds with their histories, broken bonds too.
void save_bonds(State& state, const Particles& p, const Bonds& bonds);
/// @param n number of particles, here and below
/// @throws InputError when a pair is not one of these particles, or occurs twice; as below
Bonds load_bonds(const State& state, std::size_t n);

/// Contacts that have a history.
void save_contacts(State& state, const Particles& p, const Contacts& contacts);
Contacts load_contacts(const State& state, std::size_t n);

/// Breakages not yet written out.
void save_breakages(State& state, const PairLosses& losses);
/// In the order of the ranks that saved them; a pair may occur twice.
std::vector<Breakage> load_breakages(const State& state, std::size_t n);

} // namespace mergel::dem
