/// Which pairs are bonded, and the history of bond and contact between them.
#pragma once

#include "dem/laws/bond_law.h"
#include "dem/laws/linear.h"
#include "dem/pairs/pairs.h"
#include "dem/particles/particles.h"

#include <vector>

namespace mergel::dem {

/// History of n_lanes bonds, and of the far-field contacts that act beside them.
struct BondBlock {
  Lanes gap_0;       ///< gap at which the bond was made [m]
  Lanes u_p;         ///< plastic normal displacement [m]
  Triple<Lanes> V;   ///< effective shear force on i [N]
  Triple<Lanes> M;   ///< effective bending moment on i [N m]
  Lanes T;           ///< effective twisting moment on i [N m]; 0 without twist
  Lanes intact;      ///< 1 - D; 0 once broken
  Triple<Lanes> f_s; ///< shear force of the contact on i [N]
};

/// Every pair that was ever bonded, in ascending order. A broken bond stays: its pair goes
/// on as a contact in the same place of the sums, so breaking reorders nothing.
struct Bonds {
  std::vector<Pair> pairs;
  std::vector<BondBlock>
      blocks; ///< block k holds n_lanes pairs from k n_lanes on; the last is padded as broken

  std::size_t size() const { return pairs.size(); }
  double intact(std::size_t b) const { return blocks[b / n_lanes].intact[b % n_lanes]; }
};

/// Bond these pairs as they lie: zero loads at the present gap. `pairs` ascending and
/// unique; counts the living bonds of each particle up.
Bonds make_bonds(Particles& p, const PeriodicCell& cell, std::vector<Pair> pairs);

/// One bond as output and energy book see it: true loads, that is effective loads times 1 -
/// D.
struct BondReading {
  double N;      ///< [N]
  Vec3 V, M;     ///< [N], [N m]
  double T;      ///< [N m]
  double D;      ///< damage [-]
  double energy; ///< stored by the bond [J]
};
BondReading read_bond(const Bonds& bonds, std::size_t b, const Particles& p,
                      const PeriodicCell& cell, const BondLaw& law);

} // namespace mergel::dem
