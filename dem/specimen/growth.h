/// Growth of a packing: particles with their far-field shells grow and move each other
/// apart, overdamped and without friction.
#pragma once

#include "dem/pairs/neighbours.h"
#include "dem/parallel/ghosts.h"
#include "dem/specimen/region.h"

#include <functional>

namespace mergel::dem {

/// Sweeps over all overlaps. A sweep removes a share of each overlap and adds a share of
/// the last move. Each particle adds its pairs in ascending order, so the same particles
/// give the same bits on any number of ranks.
class Growth {
public:
  /// @param p    all particles on every rank, owned and numbered along a space-filling curve
  /// @param g_a  activation gap at S = 1 [m]: shells keep a gap of g_a (S_i + S_j)/2
  /// @param skin margin of the list of pairs at S = 1 [m], > 0
  /// @param comm ranks that share the sweeps
  /// `p` and `region` must outlive it. Collective, as is all below.
  Growth(Particles& p, const Region& region, double g_a, double skin,
         const Communicator& comm = {});

  /// One sweep with all sizes times `size` <= 1. Returns the largest overlap before the
  /// moves, shells included, over the distance at which the pair would not overlap. Then a
  /// rank has the positions of its own particles and of those near them.
  double sweep(double size);

  /// To be called after R or S of particles have changed, and not during a sweep.
  void sizes_changed() { list_.invalidate(); }

  /// Give every rank all positions, and all particles as its own: the end of the sweeps.
  void gather();

  /// Overlapping pairs in the last sweep.
  std::size_t n_overlaps() const { return comm_.global_sum(n_overlaps_); }

private:
  void update_list();
  void choose_ghosts();
  double separate_pairs(double size);
  template <class Shape>
  double separate_from_boundaries(const Shape& shape, double size);
  double move();

  Particles& p_;
  const Region& region_;
  Communicator comm_;
  Partition partition_;
  Ghosts ghosts_;
  PeriodicCell cell_;
  double g_a_;
  VerletList list_;
  Contacts pairs_; ///< without forces
  std::vector<Vec3> separation_, move_;
  std::size_t n_overlaps_ = 0;
};

/// Sweeps of grow().
struct Sweeps {
  double from = 0.6; ///< factor of the sizes at the start [-]; 1: no growth
  double tolerance;  ///< overlap below which the packing counts as unjammed [-]
  int most;          ///< largest number of sweeps, growth included
};

/// Grow to full size, then sweep until no overlap exceeds the tolerance or the number of
/// sweeps is reached. Returns the largest overlap left. `progress` gets a fraction of the
/// work.
double grow(Growth& growth, const Sweeps& sweeps,
            const std::function<void(double)>& progress);

} // namespace mergel::dem
