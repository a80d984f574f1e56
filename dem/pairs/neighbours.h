/// Pairs of particles that may act on each other: cell search and Verlet list
/// (dem/README.md, Neighbour lists).
#pragma once

#include "dem/pairs/bonds.h"
#include "dem/pairs/contacts.h"

#include <algorithm>

namespace mergel::dem {

/// All pairs with gap < range (S_i + S_j)/2 + extra_i + extra_j and at least one owned
/// particle, ascending. The particles are sorted into cells by size class, a factor of two
/// per class: the cost is linear in the number of particles at any ratio of diameters.
///
/// @param range gap at S = 1 [m], >= 0
/// @param extra by particle [m], >= 0; empty: none
/// @param x positions instead of the present ones [m]; empty: these
/// @throws InputError when a periodic edge is shorter than four times the largest reach
///   R + range S/2, so that a particle could act on its own image
std::vector<Pair> find_pairs(const Particles& p, const PeriodicCell& cell, double range,
                             const std::vector<double>& extra = {},
                             const std::vector<Vec3>& x = {});

/// Skin of a list at S = 1 over the diameter of the smallest particle, by default [-].
inline constexpr double default_skin = 0.3;

/// The same beside a wall that is pushed in: some hundred steps between two rebuilds at 1 m/s.
inline constexpr double skin_under_penetration = 0.45;

/// Smallest edge of a periodic cell in which find_pairs() finds each pair once [m]: four
/// times the reach (radius plus half of the range) of the largest particle.
/// @param largest_diameter, range at S = 1 [m]
inline double smallest_edge(double largest_diameter, double range, double S)
{
  return 2.0 * S * (largest_diameter + range);
}

/// Verlet list: the pairs with a gap below g_a + skin. It holds until a particle has moved
/// by half its skin relative to the cell. A strain of the cell brings unlisted pairs nearer
/// too, and uses up a part of the skin.
///
/// A rebuild does not change results: it adds and removes only pairs that do not act, and
/// history stays with its pair.
class VerletList {
public:
  /// @param g_a activation gap; @param skin margin. Both at S = 1 [m]; both scale with S
  VerletList(double g_a, double skin) : g_a_(g_a), skin_(skin) {}

  /// Of the motion of each particle in a step the part that the list allows for beside the
  /// skin [m]; empty: none.
  const std::vector<double>& spare() const { return spare_; }
  /// The same for all steps_of_flight steps.
  const std::vector<double>& extra() const { return extra_; }

  /// Report that in the last step no particle of any rank moved by more than `most` S beyond
  /// spare() [m]. To be called after every motion of particles, or else invalidate().
  void add_motion(double most)
  {
    ++n_steps_since_built_;
    ++n_steps_since_narrowed_;
    if (n_steps_since_built_ == steps_of_flight) spare_.clear();
    last_motion_ = most;
    since_built_.motion += most;
    since_narrowed_.motion += most;
  }
  /// Report a strain of the cell that scaled its edges and all positions by these factors.
  void add_strain(const Vec3& growth)
  {
    since_built_.add_strain(growth);
    since_narrowed_.add_strain(growth);
  }

  /// True when, by the motions reported since the last build, a particle may have moved by
  /// half its skin, or when there was no build.
  bool may_be_stale(const Particles& p) const
  {
    return x_built_.size() != p.size() || since_built_.motion > allowance();
  }
  /// Largest motion over S of an owned particle relative to the cell since the last build,
  /// beyond what it had to spare [m]; infinite without a build.
  double travel(const Particles& p) const;
  /// True when a particle moved by half its skin. @param largest global max of travel() [m]
  bool is_stale(double largest)
  {
    since_built_.motion = largest;
    return largest > allowance();
  }
  /// The same on one rank.
  bool is_stale(const Particles& p) { return may_be_stale(p) && is_stale(travel(p)); }
  /// Whether the list has all pairs with a gap below (g_a + beyond) S.
  /// @param largest global max of travel() [m]; @param beyond at S = 1, below the skin [m]
  bool is_complete_to(double beyond, double largest) const
  {
    return largest <= allowance() - 0.5 * beyond;
  }

  /// Replace the pairs of `contacts`, without those that were ever bonded. Pairs that
  /// remain keep their shear force.
  ///
  /// A few particles that fly much faster than the others, debris, would make the list of
  /// all of them stale. Each of them gets an extra reach instead, its way in
  /// steps_of_flight steps. Velocities must be the same on all ranks.
  /// @param dt time step [s]; 0: no extra reach
  void rebuild(const Particles& p, const PeriodicCell& cell, const Bonds& bonds,
               Contacts& contacts, double dt = 0.0);

  /// True when a pair that is not close may act, or where none was chosen.
  bool is_narrowing_stale(const Contacts& contacts) const
  {
    return !contacts.is_narrowed ||
           (!spare_.empty() && n_steps_since_narrowed_ >= steps_of_narrowed_flight) ||
           since_narrowed_.largest(longest_reach_) > margin_;
  }
  /// Choose the close contacts: those with a gap below (g_a + margin) S, or with a shear
  /// force. Most candidates are neither, and are not examined until this is stale, some 16
  /// steps later. Changes no result.
  void narrow(const Particles& p, const PeriodicCell& cell, Contacts& contacts);

  void invalidate() { x_built_.clear(); }
  double skin() const { return skin_; }
  /// Motion of a wall after which the list is stale: half the skin of the smallest S [m].
  double wall_allowance() const { return 0.5 * smallest_skin_; }
  std::size_t n_builds() const { return n_builds_; }

private:
  /// By how much pairs that were apart may have come nearer, over S.
  struct Approach {
    double motion = 0.0;         ///< bound of that of a particle over S [m]
    Vec3 stretch = Vec3::Ones(); ///< edges of the cell over those at the start [-]

    void add_strain(const Vec3& growth)
    {
      stretch = stretch.cwiseProduct(growth);
      motion *= std::max(1.0, growth.maxCoeff());
    }
    double shortening() const { return std::max(0.0, 1.0 - stretch.minCoeff()); }
    /// Of both particles and the cell, for pairs of this distance [m].
    double largest(double reach) const { return 2.0 * motion + shortening() * reach; }
  };

  /// Half of the skin that the strain has left [m]. The cell brings an unlisted pair nearer
  /// by the largest shortening of an edge at most. With distances over S:
  ///   (1 - shortening) (reach + skin) - 2 travel >= reach
  double allowance() const
  {
    return 0.5 * (skin_ - since_built_.shortening() * longest_reach_);
  }

  static constexpr std::size_t steps_of_flight = 300, steps_of_narrowed_flight = 32;

  void allow_for_flight(const Particles& p, double dt);

  double g_a_, skin_;
  std::vector<Vec3> x_built_;
  std::vector<double> extra_, spare_;
  std::size_t n_steps_since_built_ = 0, n_steps_since_narrowed_ = 0;
  double longest_reach_ = 0.0; ///< bound of (R_i + R_j)/S + g_a + skin [m]
  double smallest_skin_ = 0.0; ///< of the smallest S [m]
  Approach since_built_, since_narrowed_;
  double last_motion_ = 0.0; ///< as reported last [m]
  double margin_ = 0.0;      ///< of the close contacts, at S = 1 [m]
  std::size_t n_builds_ = 0;
};

} // namespace mergel::dem
