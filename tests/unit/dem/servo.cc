#include "tests/support/catch.h"

#include "dem/element/servo.h"

#include <algorithm>

using namespace mergel::dem;

TEST_CASE(
    "A servo removes an error with at most the overshoot of a double pole, and leaves none "
    "under a constant disturbance",
    "[unit][dem]")
{
  // d sigma/dt = m M rate + disturbance. With proportional and integral control a double
  // pole (m = 1/4) overshoots by exp(-2) = 13.5 %, a stiffer cell by less. 400 steps are
  // 40 tau.
  const double M = 1e9, dt = 1e-7;
  for (const double m : {0.25, 1.0}) {
    Servo servo;
    servo.stiffness = Vec3::Constant(M);
    servo.limit = 1e6;
    double sigma = 0.0, most = 0.0;
    const CellControl control{AxisControl{true, 1e6, 0.0}, {}, {}};
    const auto run = [&](int n, double disturbance) {
      for (int k = 0; k < n; ++k) {
        sigma += dt * (m * M * servo.rates(control, {sigma, 0, 0}, dt).x() + disturbance);
        most = std::max(most, sigma);
      }
    };
    run(400, 0.0);
    CHECK(sigma == Approx(1e6).epsilon(0.15));
    CHECK(most < 1.14e6);
    run(4000, 0.0);
    CHECK(sigma == Approx(1e6).epsilon(1e-3));
    run(8000, -5.0 * M); // from strains of the other axes at 5/s
    CHECK(sigma == Approx(1e6).epsilon(1e-3));
    CHECK(servo.n_limited == 0);
  }
}

TEST_CASE("A servo at its limit neither exceeds it nor winds up", "[unit][dem]")
{
  Servo servo;
  servo.stiffness = Vec3::Constant(1e9);
  servo.limit = 1.0;
  const CellControl control{AxisControl{true, -1e9, 0.0}, {false, 0.0, 0.3}, {}};
  for (int k = 0; k < 100; ++k)
    CHECK(servo.rates(control, Vec3::Zero(), 1e-7) == Vec3(-1.0, 0.3, 0.0));
  CHECK(servo.integral == Vec3::Zero());
  CHECK(servo.n_limited == 100);
}
