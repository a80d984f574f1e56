/// Which rank owns which particle.
///
/// Every rank numbers all particles alike and keeps an entry for each; it moves those that it
/// owns and computes every pair and wall contact that has one of them. A pair across a border
/// is computed on both sides from the same numbers, so no force travels back, and each particle
/// adds its pairs in the same order everywhere: no bit depends on the number of ranks.
#pragma once

#include "dem/parallel/communicator.h"
#include "dem/particles/particles.h"

#include <vector>

namespace mergel::dem {

class Partition {
public:
  /// Distribute the particles by recursive coordinate bisection (Berger and Bokhari 1987) of
  /// their positions, by Zoltan. Sets the ownership of `p`, without ghosts; collective.
  /// @param weight load of each owned particle, in the order of for_owned(); empty for 1 each
  /// @pre x is up to date for owned particles
  void assign(Particles& p, const std::vector<double>& weight, const Communicator& comm);

  /// Position, velocity and spin of every particle from its owner to all ranks; collective.
  void gather_motion(Particles& p, const Communicator& comm) const;

  /// Particles of a rank, ascending. @pre assign() was called
  const std::vector<Index>& owned_by(std::size_t rank) const { return owned_by_[rank]; }

private:
  void list_owners(const Particles& p, const Communicator& comm);

  std::vector<std::vector<Index>> owned_by_; ///< by rank
};

} // namespace mergel::dem
