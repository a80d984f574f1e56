// How the stable step of a run is guarded between two evaluations.
#include "dem/assembly/step.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <limits>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3;

/// A row of bonded particles.
Assembly row(int n)
{
  Scene s;
  s.material.bond = unbreakable_bond();
  std::vector<Pair> pairs;
  for (Index k = 0; k < static_cast<Index>(n); ++k) {
    s.p.add(sphere({2.0 * R * k, 0, 0}, R));
    if (k > 0) pairs.push_back({k - 1, k, {}});
  }
  s.bond(pairs);
  return assembly_of(s);
}

void set_modulus(Assembly& a, double factor)
{
  section(a.material.bond).E = factor * unbreakable_bond().E;
}

} // namespace

TEST_CASE(
    "Between two evaluations the stable step falls with the block bound and does not grow",
    "[unit][dem]")
{
  Assembly a = row(6);
  const StepSpec spec;
  StableStep step;
  find_stable_step(step, a, spec, 0.0, 0.7);
  const double first = step.limit, dt = spec.safety * first;
  CHECK(first == Approx(2.0 / std::sqrt(1.7 * step.omega2)).epsilon(1e-14));

  set_modulus(a, 2.25);
  update_stable_step(step, a, spec, 100, dt, 0.7);
  CHECK(step.limit == Approx(first / 1.5).epsilon(1e-12));
  CHECK(step.largest_rise == Approx(2.25).epsilon(1e-12));
  set_modulus(a, 0.25);
  update_stable_step(step, a, spec, 200, dt, 0.7);
  CHECK(step.limit == Approx(first / 1.5).epsilon(1e-12));
  update_stable_step(step, a, spec, steps_between_evaluations, dt, 0.7); // is due
  CHECK(step.limit == Approx(2.0 * first).epsilon(1e-12));
  CHECK(step.largest_rise == 1.0);
}

TEST_CASE(
    "The step of the block bound is below the eigenvalue's, by up to a third, and needs "
    "no iteration to follow the bound",
    "[unit][dem]")
{
  Assembly a = row(6);
  StableStep by_bound, by_eigenvalue;
  find_stable_step(by_eigenvalue, a, {StepRule::eigenvalue, 1.0}, 0.0, 0.0);
  find_stable_step(by_bound, a, {StepRule::block_bound, 1.0}, 0.0, 0.0);
  CHECK(by_bound.limit <= by_eigenvalue.limit);
  CHECK(by_bound.limit > 0.67 * by_eigenvalue.limit); // 0.79-0.82 in specimens
  CHECK(by_bound.omega2 == by_bound.bound2);
  set_modulus(a, 4.0);
  const double before = by_bound.limit;
  update_stable_step(by_bound, a, {StepRule::block_bound, 1.0}, 100, before, 0.0);
  CHECK(by_bound.limit == Approx(0.5 * before).epsilon(1e-12));
}

TEST_CASE("Where nothing acts the step has no limit, until the first contact is found",
          "[unit][dem]")
{
  Scene s;
  s.material.contact = contact(1e8, 2.0, 0.3, 0.0);
  s.p.add(sphere({0, 0, 0}, R));
  s.p.add(sphere({3.0 * R, 0, 0}, R));
  Assembly a = assembly_of(s);
  StableStep step;
  find_stable_step(step, a, {}, 0.0, 0.0);
  CHECK(step.limit == std::numeric_limits<double>::infinity());
  CHECK(what_rules(step) == "nothing");
  a.particles.state[1].x.x() = 1.99 * R;
  a.list.invalidate();
  // 300 is no multiple of the steps between two evaluations.
  update_stable_step(step, a, {}, 300, 1e-7, 0.0);
  CHECK(step.omega2 > 0.0);
  CHECK(std::isfinite(step.limit));
}

TEST_CASE("Where another particle becomes the stiffest, the frequency is computed again",
          "[unit][dem]")
{
  Assembly a = row(6);
  const StepSpec spec{StepRule::eigenvalue, 1.0};
  StableStep step;
  find_stable_step(step, a, spec, 0.0, 0.0);
  const std::uint64_t n = step.n_evaluations, id = step.stiffest.id;
  const double limit = step.limit;
  update_stable_step(step, a, spec, 1000, 1e-7, 0.0);
  CHECK(step.n_evaluations == n);
  a.particles.state[id == 5 ? 4 : 5].m *= 0.1;        // at the end, or beside it
  update_stable_step(step, a, spec, 1900, 1e-7, 0.0); // not yet: at every 1000th step
  CHECK(step.n_evaluations == n);
  CHECK(step.limit < 0.9 * limit);
  update_stable_step(step, a, spec, 2000, 1e-7, 0.0);
  CHECK(step.stiffest.id != id);
  CHECK(step.n_evaluations == n + 1);
  StableStep anew;
  find_stable_step(anew, a, spec, 0.0, 0.0);
  CHECK(step.limit == Approx(anew.limit).epsilon(1e-12));
}

TEST_CASE("What rules the step is named: motion, particle and its upscaling ratio",
          "[unit][dem]")
{
  // The third particle is light: its translation is the fastest motion, or, with a small
  // moment of inertia, its rotation.
  Assembly a = row(5);
  a.particles.state[2].m *= 0.1;
  a.particles.state[2].S = 5.0;
  section(a.material.bond).kappa = 20.0;
  StableStep step;
  find_stable_step(step, a, {}, 0.0, 0.0);
  CHECK(what_rules(step) == "translation of particle 2 (S = 5)");
  a.motion.inertia_factor = 0.01;
  find_stable_step(step, a, {}, 0.0, 0.0);
  CHECK(what_rules(step) == "rotation of particle 2 (S = 5)");
}
