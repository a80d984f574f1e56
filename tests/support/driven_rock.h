/// Rocks in a driven periodic cell, for the tests of cell, averages and servo.
#pragma once

#include "tests/support/dem_scene.h"

#include "dem/assembly/averages.h"
#include "dem/assembly/energy_balance.h"
#include "dem/math/random.h"

#include <array>

namespace mergel::dem::test {

/// Sites of a cell over its edges, and the edges over the distance of neighbours.
struct LatticeCell {
  std::vector<Vec3> sites;
  Vec3 edges;
};

inline LatticeCell cubic_cell()
{
  return {{Vec3::Zero()}, Vec3::Ones()};
}
/// Turned by 45 degrees about z: a stretch along x and y is a shear of the crystal.
inline LatticeCell turned_cubic_cell()
{
  return {{Vec3::Zero(), {0.5, 0.5, 0.0}}, {std::sqrt(2.0), std::sqrt(2.0), 1.0}};
}
inline LatticeCell face_centred_cell()
{
  return {{Vec3::Zero(), {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}},
          Vec3::Constant(std::sqrt(2.0))};
}
inline LatticeCell turned_face_centred_cell()
{
  return {{Vec3::Zero(), {0.5, 0.5, 0.5}}, {1.0, 1.0, std::sqrt(2.0)}};
}

/// A rock, the step it takes and what strains it.
struct DrivenRock {
  Rock rock;
  double dt = 0.0;

  /// Bond what lies within `gap`, and begin.
  void start(double gap, double skin)
  {
    rock.cell.is_driven = true;
    rock.list = VerletList(rock.material.contact.g_a, skin);
    rock.bonds =
        make_bonds(rock.particles, rock.cell, find_pairs(rock.particles, rock.cell, gap));
    add_forces(rock, 0.0);
    dt = stable_time_step(rock, 0.5);
  }

  void step(const Vec3& rate)
  {
    advance(rock, dt, dt, [&](double) { rock.cell.rate = rate; });
  }
};

/// n^3 cells of a lattice of touching spheres, radius R, with bonds that do not yield.
inline DrivenRock crystal(const LatticeCell& lattice, int n, double R, double kappa)
{
  DrivenRock w;
  const Vec3 edges = 2.0 * R * lattice.edges;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c)
        for (const Vec3& s : lattice.sites)
          w.rock.particles.add(sphere((Vec3(a, b, c) + s).cwiseProduct(edges), R));
  w.rock.cell.size = n * edges;
  w.rock.material = {unbreakable_bond(), no_contact()};
  section(w.rock.material.bond).kappa = kappa;
  w.rock.motion.damping = 0.0;
  w.start(1e-3 * R, 0.1 * R);
  return w;
}

/// A face-centred crystal of n^3 cells out of order: spheres of 0.8 to 0.9 R displaced by up
/// to 0.05 R, which do not touch yet, in bonds and with friction. `place` is where grain k of the
/// crystal is put: its number and whole cells away from home.
struct Place {
  std::vector<Index> number;
  Vec3 origin = Vec3::Zero();
  bool scattered = false; ///< every other grain sits in some other cell
};
inline DrivenRock disordered_rock(int n, const Place& place = {})
{
  DrivenRock w;
  const double R = 0.5e-3;
  const LatticeCell lattice = face_centred_cell();
  const Vec3 edges = 2.0 * R * lattice.edges;
  w.rock.cell.size = n * edges;
  std::vector<Body> bodies;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c)
        for (const Vec3& s : lattice.sites) {
          const auto k = bodies.size();
          const auto draw = [k](std::uint64_t purpose) { return uniform(3, k, purpose); };
          Vec3 x = (Vec3(a, b, c) + s).cwiseProduct(edges);
          x +=
              0.1 * R * Vec3(2.0 * draw(0) - 1.0, 2.0 * draw(1) - 1.0, 2.0 * draw(2) - 1.0);
          if (place.scattered && k % 2 == 1)
            x += w.rock.cell.offset({static_cast<std::int16_t>(k % 7 - 3), 2, -1});
          bodies.push_back(sphere(x + place.origin, R * (0.8 + 0.1 * draw(3))));
        }
  for (std::size_t k = 0; k < bodies.size(); ++k)
    w.rock.particles.add(bodies[place.number.empty() ? k : place.number[k]]);
  DamageBond bond = bond_of_table_1();
  bond.E = 20e9;
  bond.sigma_t = 30e6;
  bond.sigma_c = 150e6;
  bond.C = 40e6;
  bond.u_c = 4e-6;
  bond.theta_c = 0.04;
  w.rock.material = {bond, contact(0.6e9, 2.4, 0.3, 0.02e-3)};
  w.start(0.45 * R, 0.2 * R);
  return w;
}

} // namespace mergel::dem::test
