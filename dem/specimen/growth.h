/// Growth of a cloud: spheres with their far-field shells swell and push each other apart,
/// overdamped and without friction.
#pragma once

#include "dem/pairs/neighbours.h"
#include "dem/specimen/region.h"

#include <functional>

namespace mergel::dem {

/// Sweeps over all overlaps, each removing a share of them, with a memory of the last sweep.
class Growth {
public:
  /// @param g_a  shells: two grains keep a gap of g_a (S_i + S_j)/2 [m]
  /// @param skin margin of the list of pairs at S = 1 [m], > 0
  /// `p` and `region` must outlive it.
  Growth(Particles& p, const Region& region, double g_a, double skin);

  /// One sweep at this share of all sizes. Returns the largest overlap that it met, shells
  /// included, over the distance at which the pair would not overlap.
  double sweep(double size);

  std::size_t n_overlaps() const
  {
    return n_overlaps_;
  } ///< of pairs, met by the last sweep

private:
  bool is_stale() const;
  void rebuild();
  double push_pairs(double size);
  template <class Shape>
  double push_from_boundaries(const Shape& shape, double size);
  void move();

  Particles& p_;
  const Region& region_;
  PeriodicCell cell_;
  double g_a_, skin_;
  std::vector<Pair> pairs_;
  std::vector<Vec3> x_listed_, push_, move_;
  std::size_t n_overlaps_ = 0;
};

/// Sweeps that make a packing.
struct Sweeps {
  double from = 0.6; ///< share of the sizes at the start; 1 only unjams
  double tolerance;  ///< overlap at which the packing counts as unjammed [-]
  int most;          ///< sweeps, those of the swelling included
};

/// Swell to full size, then sweep until no overlap exceeds the tolerance or the sweeps are
/// spent. Returns the largest that is left. `progress` gets a fraction of the work.
double grow(Growth& growth, const Sweeps& sweeps,
            const std::function<void(double)>& progress);

} // namespace mergel::dem
