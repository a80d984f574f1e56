#include "dem/element/controlled_pair.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

ControlledPairSpec unequal_particles(const BondLaw& bond)
{
  return {30e-3, 50e-3, 1.0, 1e-3, {bond, contact(400e6, 2.0, 0.5, 0.0)}};
}

} // namespace

TEST_CASE("The loads of a controlled pair follow from the imposed motion alone",
          "[unit][dem]")
{
  ControlledPair pair(unequal_particles(unbreakable_bond()));
  const BondShape<double> k = pair.shape();
  const RelativeMotion corners[] = {{1e-4, 0, 0}, {1e-4, 2e-4, 0}, {-3e-4, 2e-4, 5e-3}};
  for (const RelativeMotion& to : corners) {
    const RelativeMotion from = pair.motion();
    for (int n = 1; n <= 10; ++n) {
      const double t = 0.1 * n;
      pair.move_to({from.u_n + t * (to.u_n - from.u_n), from.u_s + t * (to.u_s - from.u_s),
                    from.theta + t * (to.theta - from.theta)});
    }
    const ControlledPairReading r = pair.read();
    // Round-off of 30 sums, and of a gap that is 1/800 of the distance.
    CHECK(r.N == Approx(k.k_n * to.u_n).epsilon(1e-11));
    CHECK(r.V == Approx(k.k_s * to.u_s).epsilon(1e-12).margin(1e-15));
    CHECK(r.M == Approx(k.k_b * to.theta).epsilon(1e-12).margin(1e-15));
    CHECK(r.D == 0.0);
    CHECK(std::abs(r.u_p.u_s) <= 1e-15 * 2e-4);
    CHECK(std::abs(r.u_p.theta) <= 1e-15 * 5e-3);
    // Trapezoidal work is exact for springs; the closed gap of the last corner counts.
    CHECK(pair.work() == Approx(r.stored).epsilon(1e-11));
  }
  CHECK(pair.read().f_n == 0.0); // gap 0.7 mm
}

TEST_CASE("A loading stage without motion changes no bit of a damaged pair", "[unit][dem]")
{
  ControlledPair pair(unequal_particles(bond_of_table_1()));
  for (int n = 1; n <= 10; ++n) pair.move_to({2.2e-5 * n, 1e-5 * n, 0});
  const ControlledPairReading before = pair.read();
  REQUIRE(before.D > 0.1);
  REQUIRE(before.D < 0.9);
  for (int n = 0; n < 100; ++n) pair.move_to(pair.motion());
  const ControlledPairReading after = pair.read();
  CHECK(after.N == before.N);
  CHECK(after.V == before.V);
  CHECK(after.M == before.M);
  CHECK(after.D == before.D);
}

TEST_CASE("A pair with a broken bond reports zero loads and its plastic motion at breakage",
          "[unit][dem]")
{
  ControlledPair pair(unequal_particles(bond_of_table_1()));
  for (int n = 1; n <= 200; ++n) pair.move_to({n * 5e-6, 0, 0});
  const ControlledPairReading gone = pair.read();
  CHECK(gone.D == 1.0);
  CHECK(gone.N == 0.0);
  CHECK(gone.u_p.u_n > 4.5 * 1e-4); // 4.6 u_c at D = 0.99, less one step
  CHECK(gone.u_p.u_n < 4.7 * 1e-4);
  CHECK(gone.stored == 0.0);
  CHECK(gone.f == -1.0);
  pair.move_to({-1.1e-3, 0, 0}); // back, through the gap of 1 mm: the contact acts
  CHECK(pair.read().f_n == Approx(400e6 * pi * 9e-4 / 80e-3 * 1e-4).epsilon(1e-9));
  CHECK(pair.read().N == 0.0);
}

TEST_CASE("The work on a controlled pair is stored or dissipated, also at breakage",
          "[unit][dem]")
{
  const auto error = [](int n) {
    ControlledPair pair(unequal_particles(bond_of_table_1()));
    const RelativeMotion corners[] = {{2e-4, 2e-4, 2e-3}, {-2e-4, -3e-4, 3e-3}, {0, 0, 0}};
    for (const RelativeMotion& to : corners) {
      const RelativeMotion from = pair.motion();
      for (int k = 1; k <= n; ++k) {
        const double t = static_cast<double>(k) / n;
        pair.move_to({from.u_n + t * (to.u_n - from.u_n),
                      from.u_s + t * (to.u_s - from.u_s),
                      from.theta + t * (to.theta - from.theta)});
      }
    }
    return std::abs(pair.work() - pair.read().stored - pair.dissipated()) / pair.work();
  };
  // The loss is the trapezoidal work less the stored energy, so only round-off is left:
  // 1e-12 of the distance of the centres in a gap of 2e-4 m.
  CHECK(error(100) < 1e-10);
  CHECK(error(1000) < 1e-10);
}
