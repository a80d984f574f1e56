#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/pairs/neighbours.h"

#include <bit>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Colliding, sliding, partly bonded particles in a periodic cell.
Scene gas()
{
  Scene s;
  s.material = {bond_of_table_1(), contact(50e6, 2.0, 0.4, 0.5e-3)};
  s.cell.size = {0.12, 0.12, 0.12};
  s.motion.free_rotation = true;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < 5; ++b)
      for (int c = 0; c < 5; ++c) {
        ParticleState particle =
            sphere(0.024 * Vec3(a, b, c) + 0.002 * random_vector(random),
                   0.008 + 0.004 * u(random));
        particle.v = 4.0 * random_vector(random);
        particle.omega = 100.0 * random_vector(random);
        s.p.add(particle);
      }
  auto close = find_pairs(s.p, s.cell, 0.0);
  close.resize(close.size() / 2);
  s.bond(close);
  return s;
}

struct Outcome {
  std::vector<ParticleState> state;
  double slip = 0.0;
  std::size_t builds = 0, broken = 0, narrowings = 0;
};

/// The same bits of the motion and of its friction.
bool are_alike(const Outcome& a, const Outcome& b)
{
  bool same = std::bit_cast<std::uint64_t>(a.slip) == std::bit_cast<std::uint64_t>(b.slip);
  for (std::size_t i = 0; i < a.state.size(); ++i)
    same = same && a.state[i].x == b.state[i].x && a.state[i].v == b.state[i].v &&
           a.state[i].omega == b.state[i].omega;
  return same;
}

/// Which ones are examined in each step.
enum class Pairs { all, close };

Outcome run(bool every_step, Pairs pairs)
{
  Scene s = gas();
  VerletList list(activation_gap(s.material.contact), 1.5e-3);
  const double dt = 5e-6;
  std::size_t narrowings = 0;
  for (int step = 0; step < 1500; ++step) {
    if (every_step || list.is_stale(s.p)) list.rebuild(s.p, s.cell, s.bonds, s.contacts);
    if (pairs == Pairs::close && list.is_narrowing_stale(s.contacts)) {
      list.narrow(s.p, s.cell, s.contacts);
      ++narrowings;
    }
    const auto before = s.p.state;
    s.step(dt);
    double most = 0.0; // motion/S, all S = 1
    for (std::size_t i = 0; i < before.size(); ++i)
      most = std::max(most, (s.p.state[i].x - before[i].x).norm());
    list.add_motion(most);
    for (const Load& on : s.p.load) // what fills its rows would be added to S and m
      REQUIRE((on.pad_f == 0.0 && on.pad_t == 0.0));
  }
  return {s.p.state, s.losses.slip.value(), list.n_builds(), s.losses.broken, narrowings};
}

} // namespace

TEST_CASE("Neither a rebuild of the list nor the choice of close pairs changes a bit of "
          "the motion",
          "[unit][dem]")
{
  const Outcome often = run(true, Pairs::all);
  CHECK(often.builds == 1500);
  CHECK(often.slip > 0.0); // friction acted, so there is shear history to lose
  CHECK(often.broken > 0);
  for (const Pairs pairs : {Pairs::all, Pairs::close}) {
    const Outcome seldom = run(false, pairs);
    CHECK(seldom.builds > 5);
    CHECK(seldom.builds < 300);
    CHECK(are_alike(often, seldom));
    if (pairs == Pairs::close) {
      CHECK(seldom.narrowings > seldom.builds);
      CHECK(seldom.narrowings < 500);
    }
  }
}

TEST_CASE("A rebuild keeps the shear of its pairs and leaves bonded pairs out",
          "[unit][dem]")
{
  Scene s;
  for (int k = 0; k < 4; ++k) s.p.add(sphere({2.05e-2 * k, 0, 0}, 1e-2));
  s.bond({{1, 2}});
  VerletList list(0.5e-3, 0.5e-3);
  CHECK(list.is_stale(s.p));
  list.rebuild(s.p, s.cell, s.bonds, s.contacts);
  REQUIRE(s.contacts.pairs == std::vector<Pair>{{0, 1}, {2, 3}});
  s.contacts.shear[1].f_s = {0.0, 3.0, 4.0};

  s.p.state[0].x.x() -= 0.01; // leaves the list
  list.add_motion(0.01);
  CHECK(list.is_stale(s.p));
  list.rebuild(s.p, s.cell, s.bonds, s.contacts);
  REQUIRE(s.contacts.pairs == std::vector<Pair>{{2, 3}});
  CHECK(s.contacts.shear[0].f_s == Vec3(0.0, 3.0, 4.0));
  CHECK_FALSE(list.is_stale(s.p));
}

TEST_CASE("The list is stale when a particle moved by half its skin", "[unit][dem]")
{
  Particles p;
  ParticleState b = sphere({0, 0, 0}, 1e-2);
  b.S = 2.0; // its skin is twice as wide
  p.add(b);
  p.add(sphere({1, 0, 0}, 1e-2));
  Contacts contacts;
  VerletList list(0.0, 1e-3);
  list.rebuild(p, {}, {}, contacts);
  p.state[0].x.y() = 0.99e-3;
  list.add_motion(0.99e-3); // beyond half the skin at S = 1: the list measures
  CHECK_FALSE(list.is_stale(p));
  p.state[0].x.y() = 1.01e-3;
  list.add_motion(0.01e-3);
  CHECK(list.is_stale(p));
  p.state[0].x.y() = 0.0;
  CHECK(list.wall_allowance() == Approx(0.5e-3)); // the smallest skin counts for walls
  list.invalidate();
  CHECK(list.is_stale(p));
}

namespace {

/// Particles that creep, and a fragment that flies across them at 3 m/s, with friction.
Scene debris()
{
  Scene s;
  s.material = {bond_of_table_1(), contact(50e6, 2.0, 0.4, 0.5e-3)};
  s.motion.free_rotation = true;
  std::mt19937_64 random(3);
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < 5; ++b)
      for (int c = 0; c < 5; ++c) {
        ParticleState particle = sphere(0.026 * Vec3(a, b, c), 0.01);
        particle.v = 0.05 * random_vector(random);
        s.p.add(particle);
      }
  ParticleState fragment = sphere({-0.03, 0.013, 0.013}, 0.004);
  fragment.v = {3.0, 0.2, 0.1};
  s.p.add(fragment);
  return s;
}

enum class Fragments { as_all_others, with_extra_reach };

Outcome fly(bool every_step, Fragments fragments)
{
  Scene s = debris();
  VerletList list(activation_gap(s.material.contact), 1.5e-3);
  const double dt = 1e-5;
  for (int step = 0; step < 4000; ++step) {
    if (every_step || list.is_stale(s.p))
      list.rebuild(s.p, s.cell, s.bonds, s.contacts,
                   fragments == Fragments::with_extra_reach ? dt : 0.0);
    if (list.is_narrowing_stale(s.contacts)) list.narrow(s.p, s.cell, s.contacts);
    add_contact_forces(s.material.contact, s.cell, dt, s.p, s.contacts, s.losses);
    list.add_motion(kick_and_drift(s.p, s.motion, dt, dt, s.work, list.spare()));
  }
  return {s.p.state, s.losses.slip.value(), list.n_builds()};
}

} // namespace

TEST_CASE("A fragment in flight does not make the list of all others stale", "[unit][dem]")
{
  const Outcome exact = fly(true, Fragments::as_all_others),
                plain = fly(false, Fragments::as_all_others),
                spared = fly(false, Fragments::with_extra_reach);
  CHECK(exact.state.back().v.norm() < 2.9); // it hits others on its way
  CHECK(exact.slip > 0.0);
  CHECK(plain.builds > 100);
  CHECK(spared.builds < plain.builds / 3);
  CHECK(are_alike(exact, plain));
  CHECK(are_alike(exact, spared));
}
