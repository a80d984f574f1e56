/// Assemblies in a strain-controlled periodic cell, for the tests of cell, averages and
/// servo.
#pragma once

#include "tests/support/dem_scene.h"

#include "dem/assembly/averages.h"
#include "dem/assembly/energy_balance.h"
#include "dem/math/random.h"

#include <array>

namespace mergel::dem::test {

/// Sites of a unit cell over its edges [-], and its edges over the distance of neighbours
/// [-].
struct LatticeCell {
  std::vector<Vec3> sites;
  Vec3 edges;
};

inline LatticeCell cubic_cell()
{
  return {{Vec3::Zero()}, Vec3::Ones()};
}
/// Rotated by 45 degrees about z: a stretch along x and y is a shear of the crystal.
inline LatticeCell rotated_cubic_cell()
{
  return {{Vec3::Zero(), {0.5, 0.5, 0.0}}, {std::sqrt(2.0), std::sqrt(2.0), 1.0}};
}
inline LatticeCell face_centred_cell()
{
  return {{Vec3::Zero(), {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}},
          Vec3::Constant(std::sqrt(2.0))};
}
inline LatticeCell rotated_face_centred_cell()
{
  return {{Vec3::Zero(), {0.5, 0.5, 0.5}}, {1.0, 1.0, std::sqrt(2.0)}};
}

/// An assembly in a strain-controlled cell, and its time step [s].
struct StrainControlledAssembly {
  Assembly assembly;
  double dt = 0.0;

  /// Bonds the pairs within `gap` [m], then computes forces and time step.
  void start(double gap, double skin)
  {
    assembly.cell.is_strain_controlled = true;
    assembly.list = VerletList(activation_gap(assembly.material.contact), skin);
    assembly.bonds = make_bonds(assembly.particles, assembly.cell,
                                find_pairs(assembly.particles, assembly.cell, gap));
    add_forces(assembly, 0.0);
    // Of the bound, which does not depend on how the particles are numbered.
    dt = stable_time_step(assembly, {StepRule::block_bound, 0.25});
  }

  void step(const Vec3& rate)
  {
    advance(assembly, dt, dt, [&](double) { assembly.cell.rate = rate; });
  }
};

/// n^3 cells of a lattice of touching particles of radius R [m]; the bonds do not yield.
inline StrainControlledAssembly crystal(const LatticeCell& lattice, int n, double R,
                                        double kappa)
{
  StrainControlledAssembly w;
  const Vec3 edges = 2.0 * R * lattice.edges;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c)
        for (const Vec3& s : lattice.sites)
          w.assembly.particles.add(sphere((Vec3(a, b, c) + s).cwiseProduct(edges), R));
  w.assembly.cell.size = n * edges;
  w.assembly.material = {unbreakable_bond(), no_contact()};
  section(w.assembly.material.bond).kappa = kappa;
  w.assembly.motion.damping = 0.0;
  w.start(1e-3 * R, 0.1 * R);
  return w;
}

/// Storage and position of the particles of disordered_rock(), which must not matter.
struct Place {
  std::vector<Index> number;  ///< entry k holds particle number[k]; empty: particle k
  Vec3 origin = Vec3::Zero(); ///< shift of all particles [m]
  bool scattered = false;     ///< every other particle is shifted by whole periods
};
/// A disordered face-centred crystal of n^3 cells: particles of radius 0.8 to 0.9 R,
/// displaced by up to 0.1 R along each axis, bonded and with friction. They do not touch
/// yet.
inline StrainControlledAssembly disordered_crystal(int n, const Place& place = {})
{
  StrainControlledAssembly w;
  const double R = 0.5e-3;
  const LatticeCell lattice = face_centred_cell();
  const Vec3 edges = 2.0 * R * lattice.edges;
  w.assembly.cell.size = n * edges;
  std::vector<ParticleState> particles;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c)
        for (const Vec3& s : lattice.sites) {
          const auto k = particles.size();
          const auto draw = [k](std::uint64_t purpose) { return uniform(3, k, purpose); };
          Vec3 x = (Vec3(a, b, c) + s).cwiseProduct(edges);
          x +=
              0.1 * R * Vec3(2.0 * draw(0) - 1.0, 2.0 * draw(1) - 1.0, 2.0 * draw(2) - 1.0);
          if (place.scattered && k % 2 == 1)
            x += w.assembly.cell.offset({static_cast<std::int16_t>(k % 7 - 3), 2, -1});
          particles.push_back(sphere(x + place.origin, R * (0.8 + 0.1 * draw(3))));
        }
  for (std::size_t k = 0; k < particles.size(); ++k)
    w.assembly.particles.add(particles[place.number.empty() ? k : place.number[k]]);
  DamageBond bond = bond_of_table_1();
  bond.E = 20e9;
  bond.sigma_t = 30e6;
  bond.sigma_c = 150e6;
  bond.C = 40e6;
  bond.u_c = 4e-6;
  bond.theta_c = 0.04;
  w.assembly.material = {bond, contact(0.6e9, 2.4, 0.3, 0.02e-3)};
  w.start(0.45 * R, 0.2 * R);
  return w;
}

} // namespace mergel::dem::test
