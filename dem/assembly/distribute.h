/// An assembly on several ranks: distribute it, gather it, rebalance the load
/// (dem/README.md, Parallel execution).
#pragma once

#include "dem/assembly/step.h"

namespace mergel::dem {

/// Whether the histories that two ranks hold of one pair are compared at every migration.
#ifdef NDEBUG
inline constexpr bool compares_histories = false;
#else
inline constexpr bool compares_histories = true;
#endif

/// Distribute an assembly that every rank holds completely: each rank then owns a part of
/// the particles and keeps the bonds, contacts and wall contacts of these. Does nothing on
/// one rank. The list is stale afterwards. Collective.
void distribute(Assembly& assembly, MPI_Comm comm);

/// The complete assembly on every rank: all motions, bonds, contacts and wall contacts with
/// their histories, and the sums of losses and works. Its `comm` is a single rank that owns
/// all particles. Collective.
///
/// @param compare whether the histories that two ranks hold of a pair across their border
///   are compared bit by bit; a difference throws std::logic_error
Assembly gather(Assembly& assembly, bool compare = compares_histories);

/// New partition with an even share of the computing time for each rank: particles migrate
/// with all their histories. No bit of any result depends on it. Collective.
/// @param seconds that this rank spent on its particles [s]
void rebalance(Assembly& assembly, double seconds, bool compare = compares_histories);

} // namespace mergel::dem
