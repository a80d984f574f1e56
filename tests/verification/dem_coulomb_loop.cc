#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("A cycle of sliding dissipates 4 mu N (U - mu N/k_s)", "[verification][dem]")
{
  const double R = 0.03, U = 2e-4, dt = 1e-4;
  const auto loop = [&](int n) { // n steps per quarter; returns {slip loss, area of the
                                 // loop} over the closed form
    Scene s;
    s.material.contact = contact(50e6, 2.0, 0.4, 0.0);
    s.p.add(sphere({0, 0, 0}, R));
    s.p.add(sphere({2.0 * R - 1e-4, 0, 0}, R));
    s.add_contacts({{0, 1}});
    const double k_n = 50e6 * pi * R / 2.0, N = k_n * 1e-4, k_s = k_n / 2.0;
    const double exact = 4.0 * 0.4 * N * (U - 0.4 * N / k_s);
    double area = 0.0, f_before = 0.0;
    const auto slide = [&](double du) {
      const double turn =
          -du / (2.0 * R - 1e-4); // equal rotations: the contact points separate along y
      s.p.state[0].omega = s.p.state[1].omega = {0.0, 0.0, turn / dt};
      s.forces(dt);
      const double f = s.contacts.shear[0].f_s.y();
      area += 0.5 * (f + f_before) * du;
      f_before = f;
    };
    for (int k = 0; k < n; ++k) slide(U / n);
    const double slip_before = s.losses.slip.value(), stored = s.stored();
    area = 0.0;
    for (int k = 0; k < 2 * n; ++k) slide(-U / n);
    for (int k = 0; k < 2 * n; ++k) slide(U / n);
    CHECK(s.stored() == Approx(stored).epsilon(1e-12)); // a closed cycle
    return std::pair{(s.losses.slip.value() - slip_before) / exact, area / exact};
  };
  const auto [slip_loss, area] = loop(1000);
  CHECK(slip_loss ==
        Approx(area).epsilon(1e-10)); // the loss is the work of the shear force
  // The corner of the loop lies within a step: du^2/U^2 of it.
  CHECK(slip_loss == Approx(1.0).epsilon(1e-5));
  CHECK(loop(137).first == Approx(1.0).epsilon(1e-4));
}
