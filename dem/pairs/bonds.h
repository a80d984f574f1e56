/// The bonded pairs, with the histories of bond and contact of each.
#pragma once

#include "dem/laws/bond_law.h"
#include "dem/pairs/pairs.h"
#include "dem/particles/particles.h"

#include <vector>

namespace mergel::dem {

/// Histories of n_lanes bonds and of the far-field contacts of the same pairs.
struct BondBlock {
  Lanes gap_0;       ///< gap at which the bond was made [m]
  Lanes u_p;         ///< plastic normal displacement [m]
  Triple<Lanes> V;   ///< effective shear force on i [N]
  Triple<Lanes> M;   ///< effective bending moment on i [N m]
  Lanes T;           ///< effective twisting moment on i [N m]; 0 without twist
  Lanes intact;      ///< 1 - D; 0 once broken
  Triple<Lanes> f_s; ///< shear force of the contact on i [N]
};

/// All pairs that were ever bonded, in ascending order. A broken bond keeps its place,
/// where the contact of its pair goes on: breakage does not change the order of summation.
struct Bonds {
  std::vector<Pair> pairs;
  std::vector<BondBlock>
      blocks; ///< block k has n_lanes pairs from k n_lanes on; the last is padded as broken

  std::size_t size() const { return pairs.size(); }
  double intact(std::size_t b) const { return blocks[b / n_lanes].intact[b % n_lanes]; }
};

/// Bond these pairs without load at their present gap. Raises n_bonds of their particles.
/// @param pairs ascending and unique
Bonds make_bonds(Particles& p, const PeriodicCell& cell, std::vector<Pair> pairs);

/// One bond for output and the energy balance, with true loads on i: the effective loads
/// times 1 - D.
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
