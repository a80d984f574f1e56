#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/laws/bond_law.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("The break mode of a damage bond is the largest term of its yield function",
          "[unit][dem]")
{
  const DamageBond b = bond_of_table_1();
  const auto s = bond_shape(b, 0.03, 1.0 / 0.06);
  const double pull = b.sigma_t * s.A, push = b.sigma_c * s.A, V = b.C * s.A,
               M = 0.25 * b.sigma_t * s.A * s.R_b;
  const auto mode = [&](double n, double v, double m) {
    return break_mode(b, s,
                      {n > 0.0 ? n * pull : n * push, {0.0, v * V, 0.0}, {m * M, 0, 0}});
  };
  CHECK(mode(1.0, 0.0, 0.0) == BreakMode::tension);
  CHECK(mode(-1.0, 0.0, 0.0) == BreakMode::compression);
  CHECK(mode(0.0, 1.0, 0.0) == BreakMode::shear);
  CHECK(mode(0.0, 0.0, 1.0) == BreakMode::bending);
  CHECK(mode(0.8, 0.6, 0.0) == BreakMode::tension); // on the edge: n^2 = 0.64, v^2 = 0.36
  CHECK(mode(-0.6, 0.8, 0.0) == BreakMode::shear);
  CHECK(mode(0.6, 0.0, 0.64) == BreakMode::bending); // n^2 = 0.36
  CHECK(mode(0.7, 0.4, 0.3) == BreakMode::tension);  // 0.49, 0.05, 0.3
}

TEST_CASE("The break mode of a parallel bond is shear or the larger part of its tension",
          "[unit][dem]")
{
  ParallelBond b;
  b.E = 1e9;
  b.sigma_c = b.tau_c = 1e6;
  const auto s = bond_shape(b, 0.03, 1.0 / 0.06);
  const double pull = b.sigma_c * s.A, M = 0.25 * pull * s.R_b;
  const auto mode = [&](double N, double V, double m) {
    return break_mode(b, s, {N, {V, 0.0, 0.0}, {m, 0.0, 0.0}});
  };
  CHECK(mode(pull, 0.0, 0.0) == BreakMode::tension);
  CHECK(mode(0.0, pull, 0.0) == BreakMode::shear);
  CHECK(mode(0.1 * pull, 0.0, M) == BreakMode::bending);
}
