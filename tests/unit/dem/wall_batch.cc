// Contacts and bonds of a triangulated wall are computed a batch at a time: each gets the bits
// that it gets by itself.
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/patch_features.h"

#include <cmath>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3;
const LinearMaterial law = contact(1e9, 2.0, 0.3, 2e-5);
/// Some of these bonds break in 40 steps.
DamageBond brittle_bond()
{
  DamageBond bond = bond_of_table_1();
  bond.u_c = 1e-6;
  return bond;
}
const PairMaterials material{brittle_bond(), law};
constexpr double dt = 1e-6;

/// A square of 12 by 12 cells of 2 mm, with waves so small that it is one smooth patch.
Wall wavy_wall()
{
  constexpr int n = 12;
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      x.push_back({2.0 * R * i, 2.0 * R * j, 0.1 * R * std::sin(1.3 * i + 0.7 * j)});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  Wall wall = make_wall(x, triangles, law);
  for (std::size_t k = 0; k < x.size(); ++k)
    wall.v[k] = {0.1, 0.05 * std::cos(2.0 * k), 0.02 * std::sin(3.0 * k)};
  return wall;
}

/// Particles on the wall: most in contact, some in the air, some over edges.
std::vector<ParticleState> particles_on(const Wall& wall)
{
  std::mt19937_64 random(7);
  std::vector<ParticleState> all;
  for (int k = 0; k < 150; ++k) {
    const Vec3 u = random_vector(random);
    ParticleState b = sphere({12.0 * R * (1.0 + 0.9 * u.x()),
                              12.0 * R * (1.0 + 0.9 * u.y()), R * (1.0 + 0.12 * u.z())},
                             R);
    b.v = random_vector(random);
    b.omega = 500.0 * random_vector(random);
    all.push_back(b);
  }
  all[3].x = wall.x[40] + Vec3(0.0, 0.0, 1.01 * R); // over a node
  return all;
}

/// Particles and a wall that moves under them.
struct AtWall {
  Particles p;
  Wall wall = wavy_wall();
  PairLosses losses;

  void begin()
  {
    bond_to_wall(wall, p, 0.03 * R);
    wall.bonds_yield = true;
    rebuild_wall(wall, material, p, 0.1 * R);
  }
  void step()
  {
    for (ParticleState& b : p.state) b.x += dt * b.v;
    for (std::size_t k = 0; k < wall.x.size(); ++k) wall.x[k] += dt * wall.v[k];
    clear_loads(p);
    add_wall_forces(wall, material, dt, p, losses);
  }
};

} // namespace

TEST_CASE("A contact and a bond of a wall have the same bits among others and alone",
          "[unit][dem]")
{
  AtWall together;
  for (const ParticleState& b : particles_on(together.wall)) together.p.add(b);
  std::vector<AtWall> alone(together.p.size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    alone[k].p.add(together.p.state[k]);
    alone[k].begin();
  }
  together.begin();
  for (int n = 0; n < 40; ++n) {
    together.step();
    for (AtWall& one : alone) one.step();
  }

  std::size_t n_forces = 0, n_sliding = 0;
  for (std::size_t k = 0; k < alone.size(); ++k) {
    CHECK(alone[k].p.load[0].f == together.p.load[k].f);
    CHECK(alone[k].p.load[0].t == together.p.load[k].t);
    n_forces += together.p.load[k].f.norm() > 0.0;
  }
  // Exact sums: those of all particles are those of each, added.
  std::vector<VectorSum> f(together.wall.f.size());
  EnergySum slip, plastic;
  for (AtWall& one : alone) {
    for (std::size_t k = 0; k < f.size(); ++k) {
      const VectorSum sum = one.wall.f.sum(k);
      f[k].x += sum.x;
      f[k].y += sum.y;
      f[k].z += sum.z;
    }
    slip += one.losses.slip;
    plastic += one.losses.plastic;
    n_sliding += one.losses.slip.value() > 0.0;
  }
  for (std::size_t k = 0; k < f.size(); ++k)
    CHECK(f[k].value() == together.wall.f.value(k));
  CHECK(slip.value() == together.losses.slip.value());
  CHECK(plastic.value() == together.losses.plastic.value());
  CHECK(together.losses.broken > 0);
  CHECK(together.wall.bonds.size() > 20);
  CHECK(n_forces > 60);
  CHECK(n_sliding > 20);
}

TEST_CASE("A contact in a batch has the bits of the contact that is computed alone",
          "[unit][dem]")
{
  AtWall s;
  for (const ParticleState& b : particles_on(s.wall)) s.p.add(b);
  rebuild_wall(s.wall, material, s.p, 0.1 * R);
  PatchFeatures features;
  int n_alone = 0;
  for (int n = 0; n < 40; ++n) {
    std::vector<WallContact> before = s.wall.contacts;
    s.step();
    Particles p = s.p;
    clear_loads(p);
    PairLosses losses;
    const double moved = travel(s.wall);
    for (std::size_t c = 0; c < before.size(); ++c) {
      const Index i = before[c].particle;
      features.find(s.wall, s.wall.listed[c], p.state[i], moved);
      const std::vector<PatchFeature>& found = features.found();
      if (found.size() == 1) {
        const PatchFeature& f = found.front();
        const Vec3 v = at(s.wall.v, s.wall.topology, f.at);
        add_wall_contact(law, {f.n, f.distance - R, f.point, v}, dt, p.state[i], p.load[i],
                         before[c], losses);
        ++n_alone;
      } else if (found.empty()) {
        open_contact(law, R, before[c], losses);
      } else { // several features are no batch
        p.load[i] = s.p.load[i];
        continue;
      }
      REQUIRE(before[c].f_s == s.wall.contacts[c].f_s);
      REQUIRE(before[c].overlap == s.wall.contacts[c].overlap);
    }
    for (Index i = 0; i < p.size(); ++i) {
      REQUIRE(p.load[i].f == s.p.load[i].f);
      REQUIRE(p.load[i].t == s.p.load[i].t);
    }
  }
  CHECK(n_alone > 1000);
}
