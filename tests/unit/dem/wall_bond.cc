#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/triangulated.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 3e-3;

struct Bonded {
  Particles p;
  Wall wall = make_wall({{0, 0, 0}, {10e-3, 0, 0}, {10e-3, 10e-3, 0}, {0, 10e-3, 0}},
                        {{0, 1, 2}, {0, 2, 3}}, no_contact());
  DamageBond bond = bond_of_table_1();
  PairLosses losses;

  Bonded()
  {
    p.add(sphere({6e-3, 3e-3, 1.01 * R}, R));
    p.add(sphere({6e-3, 3e-3, 3.0 * R}, R));
    bond_to_wall(wall, p, 0.05 * R);
  }
  /// Moves the wall rigidly by u [m]; returns the force of the bond on the particle [N].
  Vec3 move_wall(const Vec3& u, bool yields, int steps = 1)
  {
    const double dt = 1.0;
    for (int k = 0; k < steps; ++k) {
      for (std::size_t n = 0; n < wall.x.size(); ++n) {
        wall.v[n] = u / (dt * steps);
        wall.x[n] += u / steps;
      }
      clear_loads(p);
      wall.bonds_yield = yields;
      add_wall_forces(wall, {bond, {}}, dt, p, losses);
    }
    return p.load[0].f;
  }
};

} // namespace

TEST_CASE("Only particles within the limit are bonded to a wall, without stress",
          "[unit][dem]")
{
  Bonded s;
  REQUIRE(s.wall.bonds.size() == 1);
  CHECK(s.wall.bonds[0].particle == 0);
  CHECK(s.wall.bonds[0].gap_0 == Approx(0.01 * R));
  CHECK(s.p.n_bonds[0] == 1);
  CHECK(s.p.n_bonds[1] == 0);
  CHECK(s.move_wall(Vec3::Zero(), true).norm() < 1e-12);
}

TEST_CASE("A wall bond has the stiffness E A/R, and 1/kappa of it in shear", "[unit][dem]")
{
  const double A = pi * R * R / 9.0, k_n = 400e6 * A / R;
  Bonded s;
  CHECK(s.move_wall({0, 0, -1e-6}, false).z() == Approx(-k_n * 1e-6).epsilon(1e-9));
  Bonded t;
  const Vec3 f = t.move_wall({1e-8, 0, 0}, false);
  CHECK(f.x() == Approx(0.5 * k_n * 1e-8).epsilon(1e-5)); // the bond rotates by 3e-6
  CHECK(t.p.load[0].t.y() == Approx(-1.01 * R * f.x()).epsilon(1e-5));
}

TEST_CASE("A wall bond that may not yield stays elastic, the other one softens and breaks",
          "[unit][dem]")
{
  const double A = pi * R * R / 9.0;
  Bonded s;
  const double u_y = 1e6 * R / 400e6;
  const Vec3 u(0.0, 0.0, -(u_y + 1e-4)); // one u_c beyond yield
  CHECK(s.move_wall(u, false).z() == Approx(-400e6 * A / R * -u.z()).epsilon(1e-9));

  Bonded t;
  CHECK(t.move_wall(u, true).z() == Approx(-1e6 * A * std::exp(-1.0)).epsilon(1e-9));
  CHECK(t.move_wall({0.0, 0.0, -4e-4}, true, 10).norm() == 0.0);
  CHECK(t.losses.broken == 1);
  CHECK(t.losses.broken_by[static_cast<std::size_t>(BreakMode::tension)] == 1);
  CHECK(t.p.n_bonds[0] == 0);
}

TEST_CASE(
    "A particle slides along a smooth wall: its bond gets no shear and keeps its direction",
    "[unit][dem]")
{
  Bonded s;
  s.wall.is_smooth = true;
  const Vec3 u(0.3 * R, -0.2 * R, -1e-6); // into the wall by 1e-6
  const int n = 10;
  for (int k = 0; k < n; ++k) {
    s.p.state[0].v = u / n;
    s.p.state[0].x += s.p.state[0].v;
    slide_anchors(s.wall, s.p, 1.0);
    clear_loads(s.p);
    add_wall_forces(s.wall, {s.bond, {}}, 1.0, s.p, s.losses);
  }
  const double A = pi * R * R / 9.0, k_n = 400e6 * A / R;
  const Vec3 f = s.p.load[0].f;
  CHECK(f.z() == Approx(k_n * 1e-6).epsilon(1e-6)); // a difference of gaps of 1e-3
  CHECK(std::hypot(f.x(), f.y()) < 1e-12 * f.z());
  CHECK(s.wall.bonds[0].V == Vec3::Zero());
  const Vec3 anchor = at(s.wall.x, s.wall.topology, s.wall.bonds[0].anchor);
  CHECK((anchor - Vec3(s.p.state[0].x.x(), s.p.state[0].x.y(), 0.0)).norm() < 1e-15);
}

TEST_CASE("The reaction of a wall bond at the nodes balances force and moment",
          "[unit][dem]")
{
  Bonded s;
  const Vec3 on_particle = s.move_wall({1e-6, 2e-6, -1e-6}, false);
  Vec3 force = on_particle, moment = s.p.state[0].x.cross(on_particle) + s.p.load[0].t;
  for (std::size_t n = 0; n < s.wall.x.size(); ++n) {
    force += s.wall.f.value(n);
    moment += s.wall.x[n].cross(s.wall.f.value(n));
  }
  CHECK(on_particle.norm() > 0.1);
  CHECK(force.norm() < 1e-12 * on_particle.norm() + 1e-14);
  CHECK(moment.norm() < 1e-12 * on_particle.norm() * R + 1e-16);
}
