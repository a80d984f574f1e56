#include "tests/support/driven_rock.h"

#include "dem/element/servo.h"

#include <catch2/catch.hpp>

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE(
    "Two axes hold their stress within 1 % of the mean while the third crushes the rock",
    "[verification][dem]")
{
  DrivenRock w = disordered_rock(4);
  Servo servo;
  servo.limit = 1e-4 / w.dt;
  const double lateral = -1e6, rate = 2e-6 / w.dt;
  const auto step = [&](const CellOrder& order) {
    if (w.rock.list.n_builds() == 0 || servo.stiffness.isZero())
      servo.stiffness = affine_stiffness(w.rock);
    const Vec3 sigma = w.rock.virial.value() / w.rock.cell.volume();
    w.step(servo.rates(order, sigma, w.dt));
    return sigma;
  };
  for (int k = 0; k < 3000; ++k)
    step({AxisOrder{true, lateral, 0.0}, {true, lateral, 0.0}, {true, lateral, 0.0}});
  Vec3 mean = Vec3::Zero();
  double worst = 0.0;
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    if (k % 100 == 0) servo.stiffness = affine_stiffness(w.rock);
    const Vec3 sigma =
        step({AxisOrder{true, lateral, 0.0}, {true, lateral, 0.0}, {false, 0.0, -rate}});
    mean += sigma / n;
    for (int a = 0; a < 2; ++a) worst = std::max(worst, std::abs(sigma[a] / lateral - 1.0));
  }
  REQUIRE(w.rock.losses.broken > 50);
  CAPTURE(mean.transpose(), worst, w.rock.losses.broken, servo.n_limited);
  CHECK(mean.x() == Approx(lateral).epsilon(0.01));
  CHECK(mean.y() == Approx(lateral).epsilon(0.01));
  CHECK(worst < 0.3); // a bond that snaps shakes the cell
  CHECK(servo.n_limited == 0);
}
