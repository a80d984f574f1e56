#include "dem/assembly/timestep.h"

#include "dem/assembly/step.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace mergel::dem {

namespace {

/// Steps after which the frequency may be computed again because another particle has become
/// the stiffest one.
constexpr std::size_t steps_between_early_evaluations = 1000;
/// Growth of the stiffness at moving walls after which the frequency is computed again.
constexpr double noticeable_growth = 1.1;

bool has_motion(const WallSystem* system)
{
  return system && system->size() > 0;
}

} // namespace

Springs present_springs(Assembly& assembly, double dt, const WallSystem* system)
{
  complete_lists(assembly, open_gap_counted(assembly), dt);
  Springs springs;
  assembly.fault.run([&] {
    const double horizon = dt * static_cast<double>(steps_between_step_checks);
    springs = linear_springs(assembly, {horizon, has_motion(system)});
  });
  assembly.comm.agree_on(assembly.fault);
  return springs;
}

namespace {

/// Sum of the stiffnesses of springs to triangulated walls [N/m]; collective.
double stiffness_of_walls(const Assembly& assembly, const Springs& springs)
{
  ForceSum sum;
  for (const WallSpring& k : springs.walls)
    if (k.wall != WallSpring::held) sum.add(k.k_n);
  ExactReduction all;
  all.add(sum);
  all.run(assembly.comm);
  return sum.value();
}

/// Leapfrog is stable to 2/omega; local damping acts as 1 + alpha times the force while it
/// brakes.
double stable(double omega2, double damping)
{
  if (!(omega2 > 0.0)) return std::numeric_limits<double>::infinity();
  return 2.0 / std::sqrt(omega2 * (1.0 + damping));
}

void find_stable_step(StableStep& step, const Assembly& assembly, const StepSpec& spec,
                      const Springs& springs, const StiffestParticle& stiffest,
                      double damping, const WallSystem* system)
{
  step.stiffest = stiffest;
  step.bound2 = step.omega2 = step.stiffest.omega2;
  step.stiffest_then = step.stiffest.id;
  ++step.n_evaluations;
  step.largest_rise = 1.0;
  step.wall_stiffness = stiffness_of_walls(assembly, springs);
  const double scale = step.bound2 > 0.0 ? step.bound2 : 1.0;
  if (spec.rule == StepRule::block_bound) {
    if (has_motion(system)) // the bound does not know what else moves
      step.omega2 =
          std::max(step.bound2, largest_frequency2(assembly, springs, scale, system));
  } else if (step.bound2 > 0.0 || has_motion(system)) {
    step.omega2 = largest_frequency2(assembly, springs, scale, system);
  }
  step.limit = stable(step.omega2, damping);
}

} // namespace

void find_stable_step(StableStep& step, Assembly& assembly, const StepSpec& spec, double dt,
                      double damping, const WallSystem* system)
{
  const auto with = [&](double dt_ahead) {
    const Springs springs = present_springs(assembly, dt_ahead, system);
    find_stable_step(step, assembly, spec, springs, block_bound(assembly, springs), damping,
                     system);
  };
  if (!(dt > 0.0)) with(0.0);
  with(dt > 0.0 ? dt : spec.safety * step.limit);
}

void update_stable_step(StableStep& step, Assembly& assembly, const StepSpec& spec,
                        std::size_t n_steps, double dt, double damping,
                        const WallSystem* system)
{
  const Springs springs = present_springs(assembly, dt, system);
  const StiffestParticle stiffest = block_bound(assembly, springs);
  const bool is_due = n_steps > 0 && n_steps % steps_between_evaluations == 0;
  const bool is_first_spring = step.bound2 == 0.0;
  const bool are_walls_stiffer =
      has_motion(system) &&
      stiffness_of_walls(assembly, springs) > noticeable_growth * step.wall_stiffness;
  const auto again = [&] {
    find_stable_step(step, assembly, spec, springs, stiffest, damping, system);
  };
  if (is_due || is_first_spring || are_walls_stiffer) return again();
  step.stiffest = stiffest;
  // Its ratio of frequency and bound may be nearer to 1 than that of the one before. While
  // rock is crushed this happens often, and the iteration costs as much as some 30 steps.
  const bool is_other = step.stiffest.id != step.stiffest_then;
  const double s2 = std::min(1.0, spec.safety * spec.safety);
  const bool may_be_unstable = s2 * step.stiffest.omega2 > step.omega2 * step.largest_rise;
  if (is_other && may_be_unstable && n_steps % steps_between_early_evaluations == 0)
    return again();
  step.largest_rise = std::max(step.largest_rise, step.stiffest.omega2 / step.bound2);
  step.limit = stable(step.omega2 * step.largest_rise, damping);
}

std::string what_rules(const StableStep& step)
{
  if (std::isinf(step.limit)) return "nothing";
  if (step.omega2 > step.bound2) return "a structure";
  char S[32];
  std::snprintf(S, sizeof S, "%.3g", step.stiffest.S);
  return std::string(step.stiffest.rotation > 0.5 ? "rotation" : "translation") +
         " of particle " + std::to_string(step.stiffest.id) + " (S = " + S + ")";
}

double stable_time_step(Assembly& assembly, const StepSpec& spec, double dt)
{
  StableStep step;
  find_stable_step(step, assembly, spec, dt, assembly.motion.damping);
  return spec.safety * step.limit;
}

} // namespace mergel::dem
