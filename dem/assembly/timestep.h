/// The time step of a run, from the largest frequency of all that acts (dem/README.md, Time
/// step).
#pragma once

#include "dem/assembly/block_bound.h"
#include "dem/assembly/largest_frequency.h"

#include <string>

namespace mergel::dem {

/// Where the stable step comes from.
enum class StepRule {
  eigenvalue, ///< the largest frequency of the system, guarded by a bound between two evaluations
  block_bound ///< the bound of the particles alone: smaller steps, mostly no iteration
};

/// Share of the stable step that is used where nothing else is asked for [-].
inline constexpr double default_safety = 0.9;
/// The same of the block bound, which is on the safe side already [-].
inline constexpr double default_block_safety = 0.98;
/// Largest share that is accepted [-]: beyond 1 a run goes unstable, which shows in its
/// energy balance.
inline constexpr double largest_safety = 1.5;

/// Steps after which the bound, and what else costs more than a step, is evaluated again.
inline constexpr std::size_t steps_between_step_checks = 100;
/// Steps after which the largest frequency is computed again.
inline constexpr std::size_t steps_between_evaluations = 5000;

struct StepSpec {
  StepRule rule = StepRule::eigenvalue;
  double safety = default_safety; ///< step over stable step, in (0, largest_safety]
};

/// The stable step of a run, which is part of its state.
struct StableStep {
  double limit =
      0.0; ///< stable step by the rule, with damping; infinite without springs [s]
  double omega2 = 0.0;         ///< squared largest frequency at the last evaluation [1/s^2]
  double bound2 = 0.0;         ///< block bound then [1/s^2]
  double largest_rise = 1.0;   ///< of the block bound since then [-], >= 1
  double wall_stiffness = 0.0; ///< of contacts and bonds with the system of the walls then,
                               ///< sum [N/m]
  StiffestParticle stiffest;   ///< at the last evaluation
  std::uint64_t stiffest_then = 0; ///< its id at the last evaluation
  std::uint64_t n_evaluations = 0; ///< so far
};

/// The springs that act until the next check. Rebuilds the lists if need be. Collective.
Springs present_springs(Assembly& assembly, double dt, const WallSystem* system);

/// Compute the stable step from the largest frequency of the present state. Rebuilds the lists
/// if need be. Collective.
/// @param dt present step [s]: contacts count that may close until the next check. 0 where
///   there is none yet: then a first evaluation finds it. Where nothing acts at all, all contacts
///   count that are nearly closed
/// @param damping the largest local damping of particles and structures [-]
/// @param system what moves the triangulated walls; null: nothing does
void find_stable_step(StableStep& step, Assembly& assembly, const StepSpec& spec, double dt,
                      double damping, const WallSystem* system = nullptr);

/// What is done every steps_between_step_checks steps: the stable step falls as the block
/// bound rises above that of the last evaluation of the largest frequency, and does not
/// grow. Evaluates that again every steps_between_evaluations steps, where another particle
/// has become the stiffest one, for whose motions the ratio of frequency and bound is
/// another, and where the springs to the system of the walls have become stiffer by a
/// tenth. Collective.
/// @param n_steps of the run
void update_stable_step(StableStep& step, Assembly& assembly, const StepSpec& spec,
                        std::size_t n_steps, double dt, double damping,
                        const WallSystem* system = nullptr);

/// What rules the step: "rotation of particle 17 (S = 5)"; "a structure".
std::string what_rules(const StableStep& step);

/// The time step of the present state [s], for those that step an assembly by themselves.
/// @param dt present step, as of find_stable_step() [s]
double stable_time_step(Assembly& assembly, const StepSpec& spec, double dt = 0.0);

} // namespace mergel::dem
