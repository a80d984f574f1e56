/// Which particles may act on each other: cell search and Verlet list.
#pragma once

#include "dem/pairs/bonds.h"
#include "dem/pairs/contacts.h"

#include <algorithm>

namespace mergel::dem {

/// Every pair with gap < range (S_i + S_j)/2 that touches an owned grain, ascending. Cells by size class, a factor of
/// two each: linear in the number of particles at any ratio of diameters.
///
/// @param range gap at S = 1 [m], >= 0
/// @throws InputError when a periodic edge is shorter than twice the longest reach, so
///   that a particle could meet its own image
std::vector<Pair> find_pairs(const Particles& p, const PeriodicCell& cell, double range);

/// Margin of a list at S = 1 over the smallest grain, where nothing asks for another.
inline constexpr double usual_skin = 0.3;

/// Shortest edge of a periodic cell in which find_pairs() sees each pair once [m]: four times
/// the reach, radius and half of the range, of the largest grain.
inline double least_edge(double largest_diameter, double range, double S)
{
  return 2.0 * S * (largest_diameter + range);
}

/// Verlet list: the pairs within g_a + skin, good until some particle has moved by half its
/// skin against the cell. A strain of the cell brings pairs nearer besides and takes its
/// share of the skin.
///
/// A rebuild is unobservable: it adds and removes only pairs that do not act, and history
/// stays with its pair.
class VerletList {
public:
  /// @param g_a activation gap, @param skin margin; both at S = 1 [m], both scale with S
  VerletList(double g_a, double skin) : g_a_(g_a), skin_(skin) {}

  /// Tell that since the last call no particle, of any rank, moved by more than `most` S [m].
  /// Whoever moves particles tells it, or invalidates the list.
  void add_motion(double most) { travel_ += most; }
  /// Tell that the cell carried all particles along, its edges growing by these factors.
  void add_strain(const Vec3& growth)
  {
    stretch_ = stretch_.cwiseProduct(growth);
    travel_ *= std::max(1.0, growth.maxCoeff());
  }

  /// True when the motions told since the last build allow a particle to have moved by half
  /// its skin, or there was no build.
  bool may_be_stale(const Particles& p) const
  {
    return x_built_.size() != p.size() || travel_ > allowance();
  }
  /// Largest motion over S of an owned particle against the cell since the last build [m];
  /// infinite without.
  double travel(const Particles& p) const;
  /// The greatest travel() of all ranks: true when a particle moved by half its skin.
  bool is_stale(double greatest)
  {
    travel_ = greatest;
    return travel_ > allowance();
  }
  /// The same on one rank.
  bool is_stale(const Particles& p) { return may_be_stale(p) && is_stale(travel(p)); }

  /// Replace the pairs of `contacts`, those ever bonded left out, and keep the shear
  /// history.
  void rebuild(const Particles& p, const PeriodicCell& cell, const Bonds& bonds,
               Contacts& contacts);

  void invalidate() { x_built_.clear(); }
  double skin() const { return skin_; }
  /// How far a wall may move before the list is stale: half the skin of the smallest S [m].
  double wall_allowance() const { return 0.5 * least_skin_; }
  std::size_t n_builds() const { return n_builds_; }

private:
  /// Half of the skin that the strain has left: a pair that was not listed is nearer by the
  /// greatest shortening at most, so with distances over S
  ///   (1 - shortening) (reach + skin) - 2 travel >= reach
  double allowance() const
  {
    const double shortening = std::max(0.0, 1.0 - stretch_.minCoeff());
    return 0.5 * (skin_ - shortening * longest_reach_);
  }

  double g_a_, skin_;
  std::vector<Vec3> x_built_;
  Vec3 stretch_ = Vec3::Ones(); ///< edges of the cell over those at the last build
  double longest_reach_ = 0.0;  ///< greatest (R_i + R_j)/S, with g_a + skin [m]
  double least_skin_ = 0.0;     ///< [m]
  double travel_ = 0.0;         ///< bound of the motion over S since the last build [m]
  std::size_t n_builds_ = 0;
};

} // namespace mergel::dem
