#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/pairs/neighbours.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("A pair across a periodic boundary has the forces of the same pair without one",
          "[unit][dem]")
{
  // All lengths are sums of powers of two: the image is exactly where the neighbour is
  // without boundaries, and the forces must agree to the last bit.
  const auto pair = [](bool periodic) {
    Scene s;
    s.material = {bond_of_table_1(), contact(0.63e9, 2.4, 0.3, 0x1p-8)};
    s.p.add(sphere({0x1p-4, 0x1p-3, 0.0}, 0x1p-4));
    s.p.add(sphere({0x1p-4 - 0x1p-3, 0x1p-3 + 0x1p-9, 0x1p-10}, 0x1p-4));
    s.p.state[1].omega = {1.0, -2.0, 3.0};
    s.p.state[0].v = {0.0, 0.5, -0.25};
    s.cell.size = periodic ? Vec3(1.0, 1.0, 0.0) : Vec3::Zero();
    if (periodic) s.p.state[1].x += Vec3(1.0, -2.0, 0.0); // two cells away from the contact
    const auto pairs = find_pairs(s.p, s.cell, activation_gap(s.material.contact));
    REQUIRE(pairs.size() == 1);
    CHECK(pairs[0].shift == (periodic ? Shift{-1, 2, 0} : Shift{0, 0, 0}));
    s.bond(pairs);
    for (int step = 0; step < 20; ++step) {
      s.forces(1e-6);
      s.p.state[0].omega += Vec3(0.1, 0.0, 0.2);
    }
    return s;
  };
  const Scene open = pair(false), across = pair(true);
  CHECK(open.p.load[0].f.norm() > 0.0);
  CHECK(open.p.load[0].t.norm() > 0.0);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(open.p.load[i].f == across.p.load[i].f);
    CHECK(open.p.load[i].t == across.p.load[i].t);
  }
  CHECK(open.stored() == across.stored());
}

TEST_CASE("An unbonded pair across a periodic boundary is a contact", "[unit][dem]")
{
  Scene s;
  s.material.contact = contact(0.63e9, 2.4, 0.3, 0.0);
  s.cell.size = {0.5, 0.5, 0.5};
  s.p.add(sphere({0.01, 0.2, 0.2}, 0.02));
  s.p.add(sphere({0.48, 0.2, 0.2}, 0.02)); // 30 mm from the image, overlap 10 mm
  s.add_contacts(find_pairs(s.p, s.cell, 0.0));
  REQUIRE(s.contacts.pairs == std::vector<Pair>{{0, 1, {-1, 0, 0}}});
  s.forces(0.0);
  const double k_n = 0.63e9 * pi * 0.02 * 0.02 / 0.04;
  CHECK(s.p.load[0].f.x() == Approx(k_n * 0.01).epsilon(1e-12));
  CHECK(s.p.load[1].f.x() == Approx(-k_n * 0.01).epsilon(1e-12));
  CHECK(s.p.load[0].t.norm() == 0.0);
}
