/// A coupled system comes to equilibrium (coupling/README.md, Start of a coupled run).
#pragma once

#include "coupling/coupled_system.h"

#include <functional>
#include <string>

namespace mergel::coupling {

/// When a state counts as equilibrium.
struct EquilibriumSpec {
  double ratio = 1e-4;             ///< unbalanced-force ratio to reach [-], in (0, 1)
  std::size_t max_steps = 200'000; ///< per phase
};

/// What is told of a phase on its way; empty functions tell nothing.
struct EquilibriumReport {
  std::function<void(const std::string& phase)> begin;
  /// @param fraction part of the phase that is done, 0 to 1
  std::function<void(double fraction, const std::string& detail)> update;
  std::function<void(const std::string& detail)> done;
};

/// The assembly settles in held walls; structures that have a static solution are solved
/// under its forces, and the particles follow; then all settle together. Continues from
/// `coupled.settling`. Collective.
/// @param after_step called between two steps, for checkpoints; may be empty
/// @throws Unstable when a bond breaks or a phase takes more than spec.max_steps
void equilibrate(CoupledSystem& coupled, const EquilibriumSpec& spec,
                 const EquilibriumReport& report = {},
                 const std::function<void()>& after_step = {});

} // namespace mergel::coupling
