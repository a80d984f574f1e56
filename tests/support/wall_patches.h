/// Smooth patches of triangles, and a particle that is put anywhere on them.
#pragma once

#include "tests/support/dem_scene.h"

#include "dem/walls/triangulated.h"

#include <cmath>

namespace mergel::dem::test {

inline constexpr double R = 1e-3, g_a = 2e-5;
inline const LinearMaterial smooth = contact(1e9, 2.0, 0.0, g_a);
inline const LinearMaterial rough = contact(1e9, 2.0, 0.3, g_a);
inline HertzMaterial hertz(double mu)
{
  return {1e9, 0.3, mu};
}

/// Two triangles over a square of 10 mm about the origin, folded along their diagonal [rad]: a
/// valley for positive angles.
inline Wall folded_square(double angle, const ContactLaw& law)
{
  const double a = 5e-3;
  const Vec3 hinge = Vec3(1.0, 1.0, 0.0).normalized(), corner(-a, a, 0.0);
  return make_wall(
      {{-a, -a, 0}, {a, -a, 0}, {a, a, 0}, Eigen::AngleAxisd(angle, hinge) * corner},
      {{0, 1, 2}, {0, 2, 3}}, law);
}

/// Six triangles around the origin, whose rim is higher: a pit. Lower: a dome.
inline Wall hexagon(double rim, const ContactLaw& law)
{
  std::vector<Vec3> x{Vec3::Zero()};
  std::vector<Triangle> triangles;
  for (int k = 0; k < 6; ++k) {
    x.push_back({3.0 * R * std::cos(k * pi / 3.0), 3.0 * R * std::sin(k * pi / 3.0), rim});
    triangles.push_back({0, 1 + k, 1 + (k + 1) % 6});
  }
  return make_wall(x, triangles, law);
}

/// 4 by 4 cells with random heights and sides, about the origin.
/// @param cell, height [m]
inline Wall bumpy_grid(double cell, double height, std::uint64_t seed,
                       const ContactLaw& law)
{
  std::mt19937_64 random(seed);
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i)
      x.push_back(Vec3(cell * i, cell * j, 0.0) +
                  random_vector(random).cwiseProduct(Vec3(0.2 * cell, 0.2 * cell, height)));
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i;
      triangles.push_back({a, a + 1, a + 6});
      triangles.push_back({a, a + 6, a + 5});
    }
  return make_wall(x, triangles, law);
}

/// A bowl around the point R above the origin with four pits, so that a particle there touches
/// the ridges between them first.
inline Wall four_pits(const ContactLaw& law)
{
  std::vector<Vec3> flat;
  std::vector<Triangle> triangles;
  constexpr int n = 3, row = 2 * n + 1;
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i) flat.push_back({0.12 * R * i, 0.12 * R * j, 0.0});
  for (int j = 0; j < row - 1; ++j)
    for (int i = 0; i < row - 1; ++i) {
      const int a = row * j + i;
      triangles.push_back({a, a + 1, a + row + 1});
      triangles.push_back({a, a + row + 1, a + row});
    }
  Wall wall = make_wall(flat, triangles, law); // one patch, as a membrane that deforms
  const Vec3 c(0.0, 0.0, R);
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i) {
      const bool is_pit = std::abs(i) == 1 && std::abs(j) == 1;
      Vec3& x = wall.x[uz(row * (j + n) + i + n)];
      x = c + (is_pit ? 1.2 : 1.0) * R * (x - c).normalized();
    }
  return wall;
}

struct NamedWall {
  const char* name;
  Wall wall;
};

inline std::vector<NamedWall> walls(const ContactLaw& law)
{
  std::vector<NamedWall> all;
  for (const double degrees : {5.0, 15.0, 25.0}) {
    all.push_back({"valley", folded_square(degrees * pi / 180.0, law)});
    all.push_back({"ridge", folded_square(-degrees * pi / 180.0, law)});
  }
  all.push_back({"pit", hexagon(0.3 * R, law)});
  all.push_back({"dome", hexagon(-0.3 * R, law)});
  for (const std::uint64_t seed : {1, 2, 3})
    all.push_back({"grid", bumpy_grid(R, 0.06 * R, seed, law)});
  all.push_back({"fine grid", bumpy_grid(0.5 * R, 0.02 * R, 5, law)});
  all.push_back({"four pits", four_pits(law)});
  return all;
}

/// One particle at a wall; its candidates are found anew at each place.
struct Probe {
  Wall wall;
  Particles p;
  PairLosses losses;

  explicit Probe(const Wall& w) : wall(w) { p.add(sphere(Vec3::Zero(), R)); }

  Vec3 force_at(const Vec3& x, double dt = 0.0)
  {
    p.state[0].x = x;
    clear_loads(p);
    rebuild_wall(wall, {}, p, 0.05 * R);
    add_wall_forces(wall, {}, dt, p, losses);
    return p.load[0].f;
  }
  double stored() const { return stored_energy(wall, {}, p).value(); }
};

} // namespace mergel::dem::test
