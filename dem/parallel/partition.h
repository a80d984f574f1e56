/// Which rank owns which particle.
///
/// All ranks number the particles in the same way and have an entry for each. A rank moves
/// the particles that it owns, and computes all pairs and wall contacts of them. A pair
/// across a border is computed on both ranks from the same numbers, so no force is sent.
/// Each particle adds its pairs in the same order on every rank: the results have the same
/// bits on any number of ranks (dem/README.md, Parallel execution).
#pragma once

#include "dem/parallel/communicator.h"
#include "dem/particles/particles.h"

#include <vector>

namespace mergel::dem {

class Partition {
public:
  /// Distribute the particles by recursive coordinate bisection (Berger and Bokhari 1987)
  /// of their positions, by Zoltan; fewer than `bisected_from` a rank as assign_by_index() does.
  /// Sets the ownership of `p`, without ghosts; collective.
  /// @param weight load of each owned particle, in the order of for_owned(); empty for 1
  ///   each
  /// @pre x is up to date for owned particles
  void assign(Particles& p, const std::vector<double>& weight, const Communicator& comm);

  /// Distribute the particles in equal parts by their index: compact where they are numbered
  /// along a space-filling curve. Sets the ownership of `p`, without ghosts; collective.
  void assign_by_index(Particles& p, const Communicator& comm);

  /// Send position, velocity and spin of every particle from its owner to all ranks;
  /// collective.
  void gather_motion(Particles& p, const Communicator& comm) const;

  /// Particles of a rank, ascending. @pre assign() was called
  const std::vector<Index>& owned_by(std::size_t rank) const { return owned_by_[rank]; }
  /// The rank that owns each particle. @pre assign() was called
  std::vector<int> owners() const;

  /// Particles a rank from which bisection serves [-]. Zoltan fails with fewer particles than
  /// ranks, and with a few a rank there is nothing to balance.
  static constexpr std::size_t bisected_from = 8;

private:
  void list_owners(const Particles& p, const Communicator& comm);

  std::vector<std::vector<Index>> owned_by_; ///< by rank
};

} // namespace mergel::dem
