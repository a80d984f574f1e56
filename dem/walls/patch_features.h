/// Where a particle touches a smooth patch of a triangulated wall (dem/README.md, Walls).
#pragma once

#include "dem/walls/triangulated.h"

#include <cstdint>
#include <vector>

namespace mergel::dem {

/// A point of a patch at which the distance to a centre c is stationary over the patch.
struct PatchFeature {
  enum class On { face, edge, corner } on;
  int which; ///< edge (k, k+1) or corner k
  Anchor at;
  Vec3 point;      ///< [m]
  Vec3 n;          ///< unit, from c to the point
  double distance; ///< from c [m]
  double overlap;  ///< R + g_a S - distance, > 0 [m]
  /// 1 for a smallest or largest distance, -1 for a saddle (an edge at the bottom of a valley),
  /// less where more ways lead down. All signs of a flat or smooth patch sum to 1. A corner at
  /// which several parts of the patch meet counts once for each.
  double sign;
};

/// Whether the centre is on the side of the particles, by the mean normal of the triangles around
/// the feature, weighted with their angles. At the boundary of a wall there is no wrong side.
/// Source: Baerentzen and Aanaes (2005), IEEE Trans. Vis. Comput. Graph. 11, 243.
bool is_in_front(const Wall& wall, const PatchFeature& feature);

/// The features of a candidate's patch in contact. The energy of the contact is the sum of
/// sign times that of each overlap. So a flat patch acts as one contact wherever its edges and
/// corners lie, the sides of a deep valley act each by itself, and between these force and
/// energy are continuous: where a side begins to act, so does the edge, and they cancel.
/// Source: Morse theory, as for the Euler characteristic; dem/README.md, Walls.
///
/// A feature counts 1 less the number of separate ways down from it. Whether the distance
/// falls from a corner along an edge has the same bits in all triangles, and whether it falls
/// from an edge into a triangle is asked in one way. The sign of a face follows from these
/// answers alone. So each triangle counts 1 in all, and the signs of a flat patch sum to 1
/// also where round-off decides. The answers of n_lanes triangles are found together, and the
/// ways are counted by edge and corner of the candidate.
class PatchFeatures {
public:
  /// @param wall_travel bound of the motion of a node since the candidate was listed [m]
  /// @throws NumericalError when the centre is on the wrong side of the wall
  void find(const Wall& wall, const ListedCandidate& candidate,
            const ParticleState& particle, double wall_travel);
  /// Of all that lie within `reach` [m] of a centre x; an overlap is reach - distance.
  void find_within(const Wall& wall, const ListedCandidate& candidate, const Vec3& x,
                   double reach)
  {
    find_within(wall, candidate, wall.near_triangles(candidate), x, reach);
  }
  /// @param near the triangles of the candidate, instead of those that the wall lists
  void find_within(const Wall& wall, const ListedCandidate& candidate,
                   std::span<const NearTriangle> near, const Vec3& x, double reach);

  const std::vector<PatchFeature>& found() const { return found_; }
  /// The closest point of the patch. @pre found() is not empty
  const PatchFeature& nearest() const;

private:
  class Scan;

  /// A triangle that may touch.
  struct LookedAt {
    const NearTriangle* near;
    unsigned foot; ///< bit e: the foot of c lies on edge e
    int sign_of_face;
  };

  std::vector<PatchFeature> found_;
  std::vector<LookedAt> looked_at_;
  std::vector<std::uint8_t> n_ways_; ///< down, from the nodes and then the edges
};

} // namespace mergel::dem
