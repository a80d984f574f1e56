/// A rock on several ranks: sharing it out, bringing it together, moving it between them.
#pragma once

#include "dem/assembly/step.h"

namespace mergel::dem {

/// Whether the histories that two ranks hold of one pair are compared at every migration.
#ifdef NDEBUG
inline constexpr bool compares_histories = false;
#else
inline constexpr bool compares_histories = true;
#endif

/// From a rock that every rank holds whole to one of which each owns a part and keeps what
/// touches it. Nothing on one rank. The list is stale afterwards. Collective.
void share_out(Rock& rock, MPI_Comm comm);

/// The whole rock on every rank: all motions, bonds, contacts and wall contacts with their
/// histories, and the sums of losses and works. Its comm is one rank that owns everything.
/// Collective.
///
/// @param compare the histories that two ranks hold of a pair across their border are
///   compared bit by bit, and a difference throws std::logic_error
Rock whole(Rock& rock, bool compare = compares_histories);

/// Own what an even share of `seconds`, the time that each rank spent on its grains, asks
/// for: grains migrate with all their histories. No bit of any result depends on it.
/// Collective.
void rebalance(Rock& rock, double seconds, bool compare = compares_histories);

} // namespace mergel::dem
