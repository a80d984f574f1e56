// Which springs count for the stable step, and how stiff they are.
#include "dem/assembly/springs.h"
#include "dem/assembly/block_bound.h"
#include "dem/assembly/largest_frequency.h"
#include "dem/assembly/step.h"
#include "tests/support/catch.h"
#include "tests/support/strain_controlled_assembly.h"

#include <cstring>
#include <limits>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3, g_a = 1e-5, skin = 4e-4, v = 0.5;
constexpr double counted = 0.25 * skin; // open_gap_counted()

enum class Beside { particle, plane, triangles, mirror };
constexpr std::array all_kinds{Beside::particle, Beside::plane, Beside::triangles,
                               Beside::mirror};

/// A particle whose contact with what is at y < 0 is open by `open` beyond the activation
/// gap [m] and closes at v.
Assembly closing_on(Beside what, double open, double speed = v)
{
  Assembly a;
  const ContactLaw law = contact(1e8, 2.0, 0.3, g_a);
  a.material = {unbreakable_bond(), law};
  a.list = VerletList(g_a, skin);
  // The gap to the image is twice the height, and closes twice as fast.
  const double share = what == Beside::mirror ? 0.5 : 1.0;
  ParticleState b = sphere({0.0, R + share * (g_a + open), 0.0}, R);
  b.v = {0.0, -share * speed, 0.0};
  a.particles.add(b);
  if (what == Beside::particle) a.particles.add(sphere({0.0, -R, 0.0}, R));
  if (what == Beside::plane)
    a.rigid_walls.push_back(make_rigid_wall(Plane{Vec3::UnitY()}, Vec3::Zero(), law));
  if (what == Beside::triangles)
    a.walls.push_back(make_wall({{-1, 0, -1}, {0, 0, 2}, {1, 0, -1}}, {{0, 1, 2}}, law));
  if (what == Beside::mirror) a.mirrors.emplace_back();
  rebuild_lists(a);
  return a;
}

std::size_t n_springs(const Assembly& a, double horizon)
{
  const Springs s = linear_springs(a, {horizon, false});
  return s.pairs.size() + s.walls.size();
}

bool same_bits(const Springs& a, const Springs& b)
{
  if (a.pairs.size() != b.pairs.size() || a.walls.size() != b.walls.size()) return false;
  const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  for (std::size_t k = 0; k < a.pairs.size(); ++k) {
    const PairSpring &p = a.pairs[k], &q = b.pairs[k];
    if (p.i != q.i || p.j != q.j || !same(p.k_n, q.k_n) || !same(p.k_s, q.k_s) ||
        !same(p.a_i, q.a_i) || p.n != q.n)
      return false;
  }
  for (std::size_t k = 0; k < a.walls.size(); ++k) {
    const WallSpring &p = a.walls[k], &q = b.walls[k];
    if (p.particle != q.particle || !same(p.k_n, q.k_n) || !same(p.arm, q.arm) ||
        p.n != q.n || p.wall != q.wall || p.at.triangle != q.at.triangle)
      return false;
  }
  return true;
}

} // namespace

TEST_CASE("A contact that closes within the horizon at twice its speed counts, a later one "
          "does not",
          "[unit][dem]")
{
  const double open = 0.8 * counted, needed = open / (2.0 * v); // [s]
  for (const Beside what : all_kinds) {
    CAPTURE(static_cast<int>(what));
    const Assembly a = closing_on(what, open);
    CHECK(open_gap_counted(a) == Approx(counted));
    CHECK(n_springs(a, 0.99 * needed) == 0);
    CHECK(n_springs(a, 1.01 * needed) == 1);
    CHECK(n_springs(closing_on(what, -0.1 * g_a), 0.0) == 1);         // closed
    CHECK(n_springs(closing_on(what, open, -v), 1.01 * needed) == 0); // opens
  }
}

TEST_CASE(
    "A contact wider than a quarter of the skin does not count, however fast it closes",
    "[unit][dem]")
{
  // The lists need not have it: what counts would depend on when they were built.
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Beside what : all_kinds) {
    CAPTURE(static_cast<int>(what));
    CHECK(n_springs(closing_on(what, 1.01 * counted), 1e3) == 0);
    CHECK(n_springs(closing_on(what, 1.01 * counted), infinite) == 0);
    // Where no step is known yet, all that are nearly closed count.
    CHECK(n_springs(closing_on(what, 0.99 * counted, 0.0), infinite) == 1);
  }
}

TEST_CASE("A bond has its present stiffness, and none when it is broken", "[unit][dem]")
{
  Scene s;
  s.material.bond = unbreakable_bond();
  s.p.add(sphere({0, 0, 0}, R));
  s.p.add(sphere({2.0 * R + 1e-5, 0, 0}, R));
  s.bond({{0, 1, {}}});
  const auto k = bond_shape(section(s.material.bond), R, 0.5 / R);
  for (const double intact : {1.0, 0.3}) {
    s.bonds.blocks[0].intact[0] = intact;
    const Assembly a = assembly_of(s);
    const Springs springs = linear_springs(a, {});
    REQUIRE(springs.pairs.size() == 1);
    const PairSpring& spring = springs.pairs.front();
    CHECK(spring.k_n == intact * k.k_n);
    CHECK(spring.k_s == intact * k.k_s);
    CHECK(spring.k_b == intact * k.k_b);
    CHECK(spring.a_i == Approx(R + 0.5e-5).epsilon(1e-12)); // to the middle of the gap
  }
  s.bonds.blocks[0].intact[0] = 0.0;
  CHECK(linear_springs(assembly_of(s), {}).pairs.empty());
}

TEST_CASE("What counts for the stable step has the same bits whenever the lists were built",
          "[unit][dem]")
{
  auto w = disordered_crystal(3);
  Assembly& a = w.assembly;
  for (Index i = 0; i < a.particles.size(); ++i)
    for (int c = 0; c < 3; ++c)
      a.particles.state[i].v[c] =
          4.0 * uniform(9, i, static_cast<std::uint64_t>(c)) - 2.0; // [m/s]
  const ContactLaw law =
      contact(0.6e9, 2.4, 0.3, 0.12e-3); // closes across the gaps of bonds
  a.material.contact = law;
  a.list = VerletList(activation_gap(law), a.list.skin());
  const double L = a.cell.size.x(), z = -0.9 * 0.5e-3;
  a.walls.push_back(
      make_wall({{-L, -L, z}, {3.0 * L, -L, z}, {0.0, 3.0 * L, z}}, {{0, 1, 2}}, law));
  rebuild_lists(a);
  const double limit = open_gap_counted(a), horizon = 100.0 * w.dt;
  bool were_stale = false, is_any_open = false;
  for (int k = 0; k < 10; ++k) {
    for (int n = 0; n < 7; ++n) w.step(Vec3(1e-6, 0.0, -3e-6) / w.dt);
    Assembly fresh = a, completed = a;
    rebuild_lists(fresh);
    complete_lists(completed, limit);
    were_stale |= completed.list.n_builds() != a.list.n_builds();
    const Springs x = linear_springs(completed, {horizon, true}),
                  y = linear_springs(fresh, {horizon, true});
    REQUIRE(same_bits(x, y));
    is_any_open |= !same_bits(x, linear_springs(completed, {0.0, true}));
    const double omega2 = block_bound(completed, x).omega2;
    CHECK(omega2 == block_bound(fresh, y).omega2);
    CHECK(largest_frequency2(completed, x, omega2) == largest_frequency2(fresh, y, omega2));
  }
  CHECK(were_stale);  // lists that were not complete took part,
  CHECK(is_any_open); // and contacts that are yet to close
}

TEST_CASE("A particle in a valley of a patch has springs as stiff as its contact",
          "[unit][dem]")
{
  // The height over the edge, which is out of reach in the last.
  const auto [degrees, height] = GENERATE(table<double, double>(
      {{2.0, 0.99}, {15.0, 0.99}, {15.0, 1.005}, {29.0, 0.99}, {29.0, 1.02}}));
  const ContactLaw law = contact(1e8, 2.0, 0.0, g_a);
  const double rise = std::sin(0.5 * degrees * pi / 180.0);
  Assembly a;
  a.material = {unbreakable_bond(), law};
  a.list = VerletList(g_a, skin);
  a.particles.add(sphere({0.0, height * R, 0.0}, R));
  const double side = std::sqrt(1.0 - rise * rise);
  a.walls.push_back(make_wall({{0, 0, -1}, {0, 0, 1}, {side, rise, 0}, {-side, rise, 0}},
                              {{0, 1, 2}, {0, 3, 1}}, law));
  REQUIRE(a.walls[0].topology.n_patches == 1);
  rebuild_lists(a);

  Eigen::Matrix3d springs = Eigen::Matrix3d::Zero(), contact;
  for (const WallSpring& k : linear_springs(a, {0.0, false}).walls)
    springs += k.k_n * k.n * k.n.transpose();
  const auto force_at = [&](const Vec3& x) -> Vec3 {
    a.particles.state[0].x = x;
    clear_loads(a.particles);
    add_wall_forces(a.walls[0], a.material, 0.0, a.particles, a.losses);
    return a.particles.load[0].f;
  };
  const Vec3 x = a.particles.state[0].x;
  constexpr double h = 1e-6 * R;
  for (int d = 0; d < 3; ++d)
    contact.col(d) =
        (force_at(x - h * Vec3::Unit(d)) - force_at(x + h * Vec3::Unit(d))) / (2.0 * h);
  CAPTURE(degrees, height, springs, contact);
  // What a force adds when it rotates is left out: the overlap over the radius, 3 % at most.
  CHECK((springs - contact).norm() < 0.04 * contact.norm());
}
