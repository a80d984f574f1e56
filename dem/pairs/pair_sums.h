/// Sums over all pairs: their stored energy and the size of their forces.
#pragma once

#include "dem/pairs/forces.h"

namespace mergel::dem {

/// A pair counts on the rank that owns its first particle. Contacts are those of bonded pairs,
/// too.
struct PairSums {
  EnergySum bonds, contacts; ///< stored [J]
  ForceSum forces; ///< magnitudes of bond and contact forces, each for both particles [N]
};

/// At the present positions, with the histories of the last step.
PairSums sum_pairs(const PairMaterials& material, const PeriodicCell& cell,
                   const Particles& p, const Bonds& bonds, const Contacts& contacts);

} // namespace mergel::dem
