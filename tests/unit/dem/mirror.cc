#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/mirror.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 30e-3;

struct Halved {
  Particles p;
  Mirror mirror;
  PairMaterials material{bond_of_table_1(), no_contact()};
  PairLosses losses;

  Halved()
  {
    p.add(sphere({0.0, R, 0.0}, R)); // touches the plane and its image
    bond_to_mirror(mirror, p, 1e-3);
  }
  void move(double u)
  {
    p.state[0].v.y() = u / 1e-4;
    p.state[0].x.y() += u;
    clear_loads(p);
    add_wall_forces(mirror, material, 1e-4, p, losses);
  }
  double stored() const { return stored_energy(mirror, material, p).value(); }
};

} // namespace

TEST_CASE("A bond to the mirror image stretches by twice the displacement", "[unit][dem]")
{
  Halved s;
  CHECK(s.p.n_bonds[0] == 1);
  s.move(1e-6);
  const double k_n = 400e6 * (pi * 1e-4) / (2.0 * R); // R_b = 10 mm
  CHECK(s.p.load[0].f.y() == Approx(-k_n * 2e-6).epsilon(1e-9));
  CHECK(s.p.load[0].f.x() == 0.0);
  CHECK(s.mirror.force.value().y() == Approx(s.p.load[0].f.y()).epsilon(1e-12));
  // half of the pair's energy
  CHECK(s.stored() == Approx(0.5 * 0.5 * k_n * 4e-12).epsilon(1e-9));
}

TEST_CASE("The half model has the force, the loss and the breakage of the full pair",
          "[unit][dem]")
{
  Halved half;
  Scene whole;
  whole.p.add(sphere({0.0, R, 0.0}, R));
  whole.p.add(sphere({0.0, -R, 0.0}, R));
  whole.material = half.material;
  whole.bond({{0, 1}});
  const double dt = 1e-4;
  for (int step = 0; step < 120; ++step) {
    const double u = (step % 10 < 8 ? 1.0 : -0.5) * 4e-6; // pull with some unloading
    half.move(u);
    for (const Index i : {0u, 1u}) {
      whole.p.state[i].v.y() = (i == 0 ? 1.0 : -1.0) * u / dt;
      whole.p.state[i].x += dt * whole.p.state[i].v;
    }
    whole.forces(dt);
    REQUIRE(half.p.load[0].f.y() == Approx(whole.p.load[0].f.y()).margin(1e-8));
    REQUIRE(2.0 * half.stored() == Approx(whole.stored()).margin(1e-13));
    REQUIRE(2.0 * half.losses.plastic.value() ==
            Approx(whole.losses.plastic.value()).margin(1e-13));
  }
  CHECK(half.losses.plastic.value() > 1e-3);
  CHECK(half.losses.broken == 1);
  CHECK(half.losses.broken_by == whole.losses.broken_by); // the same mode
  CHECK(whole.losses.broken == 1);
  CHECK(half.p.n_bonds[0] == 0);
  CHECK(half.losses.breakage_release.value() * 2.0 ==
        Approx(whole.losses.breakage_release.value()).epsilon(1e-6));
}

TEST_CASE(
    "A particle bonded to its image spins about the normal of the symmetry plane only",
    "[unit][dem]")
{
  Particles p;
  ParticleState b = sphere({0.0, R, 0.0}, R);
  b.omega = {1.0, 2.0, 3.0};
  p.add(b);
  Mirror mirror;
  bond_to_mirror(mirror, p, 1e-3);
  CHECK(p.state[0].omega == Vec3(0.0, 2.0, 0.0));
  p.load[0].t = {5.0, 6.0, 7.0};
  constrain_mirror_spin(mirror, p);
  CHECK(p.load[0].t == Vec3(0.0, 6.0, 0.0));
}

TEST_CASE("The image of an unbonded particle repels it and never attracts it",
          "[unit][dem]")
{
  Particles p;
  p.add(sphere({0.0, R - 1e-4, 0.0}, R));
  p.add(sphere({0.2, R + 1e-4, 0.0}, R));
  Mirror mirror;
  rebuild_wall(mirror, {}, p, 1e-3);
  REQUIRE(mirror.pairs.size() == 2);
  PairLosses losses;
  const LinearMaterial law = contact(63e6, 2.4, 0.4, 0.0);
  add_wall_forces(mirror, {bond_of_table_1(), law}, 0.0, p, losses);
  CHECK(p.load[0].f.y() == Approx(63e6 * pi * R * R / (2 * R) * 2e-4).epsilon(1e-9));
  CHECK(p.load[1].f.norm() == 0.0);

  p.state[0].x.y() = -1e-6;
  CHECK_THROWS_AS(add_wall_forces(mirror, {bond_of_table_1(), law}, 0.0, p, losses),
                  mergel::NumericalError);
}

TEST_CASE("A rebuild drops the distant pairs of the mirror and keeps the bonded ones",
          "[unit][dem]")
{
  Halved s;
  s.p.state[0].x.y() += 1.0;
  s.p.add(sphere({0.0, R + 1.0, 0.0}, R));
  rebuild_wall(s.mirror, {}, s.p, 1e-3);
  REQUIRE(s.mirror.pairs.size() == 1);
  CHECK(s.mirror.pairs[0].particle == 0);
  CHECK(s.mirror.pairs[0].bond.intact == 1.0);
}
