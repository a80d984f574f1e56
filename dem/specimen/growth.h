/// Growth of a packing: particles with their far-field shells grow and move each other
/// apart, overdamped and without friction.
#pragma once

#include "dem/pairs/neighbours.h"
#include "dem/specimen/region.h"

#include <functional>

namespace mergel::dem {

/// Sweeps over all overlaps. A sweep removes a share of each overlap and adds a share of
/// the last move.
class Growth {
public:
  /// @param g_a  activation gap at S = 1 [m]: shells keep a gap of g_a (S_i + S_j)/2
  /// @param skin margin of the list of pairs at S = 1 [m], > 0
  /// `p` and `region` must outlive it.
  Growth(Particles& p, const Region& region, double g_a, double skin);

  /// One sweep with all sizes times `size`. Returns the largest overlap before the moves,
  /// shells included, over the distance at which the pair would not overlap.
  double sweep(double size);

  std::size_t n_overlaps() const
  {
    return n_overlaps_;
  } ///< overlapping pairs in the last sweep

private:
  bool is_stale() const;
  void rebuild();
  double separate_pairs(double size);
  template <class Shape>
  double separate_from_boundaries(const Shape& shape, double size);
  void move();

  Particles& p_;
  const Region& region_;
  PeriodicCell cell_;
  double g_a_, skin_;
  std::vector<Pair> pairs_;
  std::vector<Vec3> x_listed_, separation_, move_;
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
