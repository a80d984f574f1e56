#include "apps/run/plan.h"

#include "tests/support/catch.h"

using namespace mergel::apps;

TEST_CASE(
    "The time of a run counts start, specimen, particles and what a step has beside them",
    "[unit][apps]")
{
  Plan plan;
  plan.n_particles = 1000.0;
  plan.n_steps = 10000.0;
  CHECK(time_of(plan, 100.0, 1).steps == Approx(1.0));
  CHECK(time_of(plan, 100.0, 1).specimen == 0.0); // from a file
  CHECK(time_of(plan, 100.0, 1).all() == Approx(1.0 + seconds_to_start));

  plan.is_made = true;
  plan.step_overhead = 1e-4;
  const RunTime one = time_of(plan, 100.0, 1), two = time_of(plan, 100.0, 2);
  CHECK(one.specimen == Approx(1000.0 * seconds_to_make));
  CHECK(one.steps == Approx(2.0));
  CHECK(one.all() == Approx(one.start + one.specimen + one.steps));
  // Ranks share particles and specimen, and nothing else.
  CHECK(two.start == one.start);
  CHECK(two.specimen == Approx(0.5 * one.specimen));
  CHECK(two.steps == Approx(1.5));
}
