/// An assembly with every part that a checkpoint stores, for the tests that write and read
/// checkpoints.
#pragma once

#include "dem/assembly/step.h"

namespace mergel::dem::test {

/// A row of bonded particles that moves against a plane, a triangulated wall, a mirror and
/// a cone: every kind of history is present, and none is zero.
inline Assembly assembly_with_everything(const ContactLaw& contact = LinearMaterial{
                                             1e8, 2.4, 0.3, 1e-4})
{
  Assembly assembly;
  DamageBond bond;
  bond.E = 1e9;
  bond.sigma_t = 1e6;
  bond.sigma_c = 3e6;
  bond.C = 1e6;
  bond.u_c = 1e-4;
  bond.theta_c = 0.1;
  assembly.material.bond = bond;
  assembly.material.contact = contact;
  assembly.motion.gravity = {0.0, 0.0, -9.81};
  assembly.list = VerletList(activation_gap(contact), 1e-3);
  for (int k = 0; k < 6; ++k) {
    ParticleState b;
    b.R = 0.01;
    b.x = {0.0199 * k, 0.00999, 0.00995};
    b.m = sphere_mass(b.R, 2500.0);
    b.v = {0.01 * k, 0.003, -0.02};
    b.omega = {0.0, 1.0 + k, 0.0};
    assembly.particles.add(b);
  }
  assembly.bonds =
      make_bonds(assembly.particles, assembly.cell, {{0, 1, {}}, {1, 2, {}}, {2, 3, {}}});
  RigidWall floor = make_rigid_wall(Plane{}, Vec3::Zero(), assembly.material.contact);
  floor.v = {0.001, 0.0, 0.0};
  assembly.rigid_walls.push_back(floor);
  assembly.mirrors.emplace_back();
  bond_to_mirror(assembly.mirrors.front(), assembly.particles, 1e-3);
  assembly.walls.push_back(
      make_wall({{-0.00998, -0.1, -0.1}, {-0.00998, 0.2, -0.1}, {-0.00998, 0.0, 0.2}},
                {{0, 1, 2}}, assembly.material.contact));
  assembly.walls.front().v = {{1e-3, 0, 0}, {2e-3, 0, 0}, {0, 1e-3, 0}};
  bond_to_wall(assembly.walls.front(), assembly.particles, 1e-3);
  RigidWall cone = make_rigid_wall(cone_ended(0.004, 0.004), {0.06, 0.0105, 0.0199},
                                   assembly.material.contact);
  cone.v = {0.0, 0.0, -0.05};
  assembly.rigid_walls.push_back(cone);
  add_forces(assembly, 0.0);
  return assembly;
}

/// One step of it: cone, wall and floor move at their velocities.
inline void step_with_everything(Assembly& assembly, double dt)
{
  advance(assembly, dt, dt, [&](double h) {
    for (std::size_t k = 0; k < 3; ++k)
      assembly.walls.front().x[k] += h * assembly.walls.front().v[k];
    for (RigidWall& w : assembly.rigid_walls) w.x += h * w.v;
  });
}

} // namespace mergel::dem::test
