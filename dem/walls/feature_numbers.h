/// Numbers of the corners and edges of a candidate's triangles, by which ways down from them
/// are counted (patch_features.h).
#pragma once

#include "dem/walls/triangulated.h"

#include <limits>
#include <string>

namespace mergel::dem {

/// Numbers the triangles of one candidate after the other. It has arrays of the size of the wall.
class FeatureNumbers {
public:
  explicit FeatureNumbers(const WallTopology& topo)
      : topo_(topo), node_(topo.around.size()), listed_(topo.triangles.size())
  {
  }

  /// @param near the triangles of the candidate, ascending
  void number(ListedCandidate& candidate, std::span<NearTriangle> near)
  {
    ++candidate_;
    std::size_t n_nodes = 0, n_edges = 0;
    for (NearTriangle& t : near) {
      t.n_fans = topo_.n_fans[uz(t.triangle)];
      t.corners = topo_.triangles[uz(t.triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto bit = static_cast<std::uint8_t>(1u << k);
        Mark& node = node_[uz(t.corners[k])];
        if (node.candidate != candidate_) {
          node = {candidate_, n_nodes++};
          t.owns_node |= bit;
        }
        t.node[k] = static_cast<std::uint16_t>(node.number);

        const int other = topo_.across[uz(t.triangle)][k];
        if (other < 0) t.begins_fan |= bit;
        if (other >= 0 && other < t.triangle &&
            listed_[uz(other)].candidate == candidate_) {
          const std::size_t e = place_of(t.triangle, topo_.across[uz(other)]);
          t.edge[k] = near[listed_[uz(other)].number].edge[e];
        } else {
          t.edge[k] = static_cast<std::uint16_t>(n_edges++);
          t.owns_edge |= bit;
        }
      }
      listed_[uz(t.triangle)] = {candidate_, static_cast<std::size_t>(&t - near.data())};
    }
    candidate.n_nodes = n_nodes;
    candidate.n_edges = n_edges;
    if (n_edges > std::numeric_limits<std::uint16_t>::max())
      throw NumericalError("a particle reaches " + std::to_string(near.size()) +
                           " triangles of a wall: mesh it more coarsely");
  }

private:
  struct Mark {
    std::size_t candidate = 0, number = 0;
  };

  const WallTopology& topo_;
  std::vector<Mark> node_;   ///< by node of the wall
  std::vector<Mark> listed_; ///< by triangle of the wall
  std::size_t candidate_ = 0;
};

} // namespace mergel::dem
