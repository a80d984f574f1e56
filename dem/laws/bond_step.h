/// One inelastic step of one bond, with its losses: the same between particles, at walls and
/// at the mirror.
#pragma once

#include "dem/laws/bond_law.h"
#include "dem/math/exact_sum.h"

#include <array>

namespace mergel::dem {

/// What bonds have lost since the start of a run, on one rank.
struct BondLosses {
  EnergySum plastic;          ///< plasticity and damage [J]
  EnergySum breakage_release; ///< energy released at bond breakage [J]
  std::size_t broken = 0;
  std::size_t yielded = 0; ///< yielding bonds, summed over all steps
  std::array<std::size_t, n_break_modes> broken_by{}; ///< breakages by mode
};

/// What a step did to the bond.
struct BondChange {
  bool breaks = false;
  BreakMode mode = BreakMode::tension; ///< where it breaks
};

/// Return a bond whose trial `load` is not elastic, update its state, and count what it
/// loses.
/// @param old   effective loads before the step, in the present frame
/// @param load  the trial on entry, the loads after the step on return; at breakage those
///   that broke the bond
/// @param losses null where another rank counts this bond
/// @param share of its energies that counts: 1/2 for a bond to the mirror image
template <IsBondLaw Law>
BondChange bond_step(const Law& law, const BondShape<double>& shape, double S,
                     const EffectiveLoads<double>& old, EffectiveLoads<double>& load,
                     BondState& state, BondLosses* losses, double share = 1.0)
{
  const BondReturn r = return_bond(law, shape, S, state, old, load);
  load = r.loads;
  state = r.state;
  BondChange change;
  change.breaks = state.intact == 0.0;
  if (losses) {
    ++losses->yielded;
    losses->plastic.add(share * r.loss);
  }
  if (!change.breaks) return change;
  change.mode = break_mode(law, shape, load);
  if (losses) {
    losses->breakage_release.add(share * r.breakage_release);
    ++losses->broken;
    ++losses->broken_by[static_cast<std::size_t>(change.mode)];
  }
  return change;
}

} // namespace mergel::dem
