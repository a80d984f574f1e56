/// Particles of other ranks that act on our own: which they are, and where they are now.
#pragma once

#include "dem/parallel/packed_motion.h"
#include "dem/parallel/partition.h"

#include <vector>

namespace mergel::dem {

class Ghosts {
public:
  /// Those of `is_needed` that others own become our ghosts; collective.
  void choose(Particles& p, const std::vector<char>& is_needed, const Partition& partition,
              const Communicator& comm);

  /// None: the particles have new owners.
  void clear() { neighbours_.clear(); }

  /// Position, velocity and spin of the ghosts from their owners; collective.
  void update(Particles& p, const Communicator& comm);

  /// What this rank has sent to others since the start.
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
