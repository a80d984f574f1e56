/// Ghosts, the particles of other ranks that act on particles of this rank: their choice,
/// and the exchange of their motion.
#pragma once

#include "dem/parallel/packed_motion.h"
#include "dem/parallel/partition.h"

#include <vector>

namespace mergel::dem {

class Ghosts {
public:
  /// The particles of `is_needed` (one flag per particle) that other ranks own become
  /// ghosts of this rank; collective.
  void choose(Particles& p, const std::vector<char>& is_needed, const Partition& partition,
              const Communicator& comm);

  /// Remove all ghosts, when the particles have new owners.
  void clear() { neighbours_.clear(); }

  /// Receive position, velocity and spin of the ghosts from their owners; collective.
  void update(Particles& p, const Communicator& comm);

  /// Messages and bytes that this rank has sent to others since the start.
  struct Traffic {
    std::size_t messages = 0, bytes = 0;
  };
  const Traffic& traffic() const { return traffic_; }

private:
  struct Neighbour {
    int rank;
    std::vector<Index> send, receive; ///< particles, ascending
    std::vector<PackedMotion> out, in;
  };
  std::vector<Neighbour> neighbours_;
  Traffic traffic_;
};

} // namespace mergel::dem
