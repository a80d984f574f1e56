#include "tests/dem_scene.h"

#include <catch2/catch.hpp>

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("A cantilever of bonded spheres sags by the sum of F/(k_s0 A) + F a^2/k_b0",
          "[verification][dem]")
{
  // Statics of a chain of springs: each bond carries the shear F and the moment F a, a from
  // bond to tip.
  const int n = 8;
  const double R = 0.03;
  Scene s;
  s.material.bond = unbreakable_bond();
  std::vector<Pair> pairs;
  for (Index k = 0; k <= n; ++k) {
    s.p.add(sphere({2.0 * R * k, 0, 0}, R));
    if (k > 0) pairs.push_back({k - 1, k});
  }
  s.bond(pairs);
  s.motion.damping = 0.7;
  const double R_b = R / 3.0, A = pi * R_b * R_b, k_n = 400e6 * A / (2.0 * R);
  const double k_s = k_n / 2.0, k_b = k_n * R_b * R_b / 4.0;
  double sag_per_F = 0.0;
  for (int b = 0; b < n; ++b) {
    const double a = 2.0 * R * (n - b) - R;
    sag_per_F += 1.0 / k_s + a * a / k_b;
  }
  const double sag = 1e-4 * 2.0 * R * n,
               F = sag / sag_per_F; // slope 1e-4: geometry adds 1e-8
  s.add_more = [&](double) { s.p.load[n].f.y() += F; };
  const StiffnessSums sums = stiffness_sums(s.material, s.cell, s.p, s.bonds, s.contacts);
  const double dt = time_step(sums, s.p, 0.7, {Vec3::Zero(), 0.7, false});
  for (int step = 0; step < 40000; ++step) {
    s.step(dt);
    s.p.body[0].x.setZero(); // clamped
    s.p.body[0].v.setZero();
    s.p.body[0].omega.setZero();
  }
  CHECK(s.p.body[n].x.y() == Approx(sag).epsilon(1e-5));
  s.forces(0.0);
  CHECK(s.p.load[0].f.y() == Approx(F).epsilon(1e-6)); // the clamp carries force and moment
  CHECK(s.p.load[0].t.z() == Approx(F * 2.0 * R * n).epsilon(1e-5));
}
