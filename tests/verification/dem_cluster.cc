#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/pairs/neighbours.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Forty bonded particles of radius 2.5 to 5 mm that rotate about an oblique axis and
/// vibrate.
Scene cluster(const DamageBond& bond, double spin, double shake)
{
  Scene s;
  s.material = {bond, no_contact()};
  s.motion.free_rotation = true; // the rotation constraint dissipates spin
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  while (s.p.size() < 40) {
    const ParticleState b =
        sphere(0.014 * random_vector(random), 2.5e-3 + 2.5e-3 * u(random));
    bool is_free = true;
    for (const ParticleState& other : s.p.state)
      is_free = is_free && (b.x - other.x).norm() > 0.9 * (b.R + other.R);
    if (is_free) s.p.add(b);
  }
  s.bond(find_pairs(s.p, s.cell, 1.5e-3));
  const Vec3 axis = spin * Vec3(0.3, 0.5, 0.8);
  for (ParticleState& b : s.p.state) {
    b.v = axis.cross(b.x) + shake * random_vector(random);
    b.omega = axis + shake / 4e-3 * random_vector(random);
  }
  return s;
}

struct Drifts {
  double momentum = 0.0, angular = 0.0; ///< largest drift, relative
  double energy = 0.0;                  ///< largest unexplained over the initial energy
  std::size_t broken = 0, yielded = 0;
  double lost = 0.0; ///< relative
};

Drifts run(Scene s, double dt, double duration)
{
  const double kinetic_0 = kinetic_energy(s.p);
  Drifts drifts;
  s.forces(0.0);
  kick(s.p, s.motion, 0.5 * dt, s.work);
  const Vec3 P = s.momentum(), L = s.angular_momentum();
  double P_scale = 0.0, L_scale = 0.0;
  for (const ParticleState& b : s.p.state) {
    P_scale += b.m * b.v.norm();
    L_scale += b.m * b.x.norm() * b.v.norm();
  }
  const int n = static_cast<int>(std::lround(duration / dt));
  for (int k = 0; k < n; ++k) {
    drift(s.p, dt);
    s.forces(dt);
    // At t^n the mean of both half steps is the kinetic energy to second order.
    const double before = kinetic_energy(s.p);
    kick(s.p, s.motion, dt, s.work);
    const double kinetic = 0.5 * (before + kinetic_energy(s.p));
    const double total = kinetic + s.stored() + s.losses.plastic.value() +
                         s.losses.breakage_release.value() + s.losses.slip.value();
    drifts.energy = std::max(drifts.energy, std::abs(total - kinetic_0) / kinetic_0);
    drifts.momentum = std::max(drifts.momentum, (s.momentum() - P).norm() / P_scale);
    drifts.angular = std::max(drifts.angular, (s.angular_momentum() - L).norm() / L_scale);
  }
  drifts.broken = s.losses.broken;
  drifts.yielded = s.losses.yielded;
  drifts.lost = (s.losses.plastic.value() + s.losses.breakage_release.value()) / kinetic_0;
  return drifts;
}

} // namespace

TEST_CASE("A spinning bonded cluster keeps momentum and angular momentum to round-off",
          "[verification][dem]")
{
  // Leapfrog with both forces of a pair at one point conserves both exactly, with or
  // without breakage.
  const bool breaks = GENERATE(false, true);
  const Drifts b = run(
      cluster(breaks ? bond_of_table_1() : unbreakable_bond(), 40.0, breaks ? 1.0 : 0.2),
      2e-6, 8e-3);
  CAPTURE(breaks, b.broken, b.momentum, b.angular);
  CHECK(b.momentum < 1e-13);
  CHECK(b.angular < 1e-13);
  CHECK((b.broken > 0) == breaks);
}

TEST_CASE("An elastic cluster keeps its energy to second order in the step",
          "[verification][dem]")
{
  const auto drift_at = [](double dt) {
    return run(cluster(unbreakable_bond(), 10.0, 0.05), dt, 2e-3).energy;
  };
  const double coarse = drift_at(2e-6), fine = drift_at(1e-6);
  CAPTURE(coarse, fine);
  CHECK(fine < 1e-3);
  CHECK(coarse / fine == Approx(4.0).epsilon(0.2));
}

TEST_CASE("The energy of a breaking cluster is balanced", "[verification][dem]")
{
  const auto drifts_at = [](double dt) {
    return run(cluster(bond_of_table_1(), 10.0, 0.3), dt, 1e-3);
  };
  const Drifts coarse = drifts_at(1e-6), fine = drifts_at(0.5e-6);
  CAPTURE(coarse.energy, fine.energy, fine.broken, fine.yielded, fine.lost);
  CHECK(fine.broken > 3);
  CHECK(fine.lost > 0.05);
  CHECK(fine.energy < 1e-3);
  CHECK(coarse.energy / fine.energy > 1.7);
}
