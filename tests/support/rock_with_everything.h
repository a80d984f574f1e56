/// A rock with every part that a checkpoint keeps, for the tests of what writes and reads
/// one.
#pragma once

#include "dem/assembly/step.h"

namespace mergel::dem::test {

/// A bonded row of grains at a plane, a triangulated wall, a mirror and a pile that push
/// it, on its way: every kind of history is there, and none is zero.
inline Rock rock_with_everything()
{
  Rock rock;
  DamageBond bond;
  bond.E = 1e9;
  bond.sigma_t = 1e6;
  bond.sigma_c = 3e6;
  bond.C = 1e6;
  bond.u_c = 1e-4;
  bond.theta_c = 0.1;
  rock.material.bond = bond;
  rock.material.contact = {1e8, 2.4, 0.3, 1e-4};
  rock.motion.gravity = {0.0, 0.0, -9.81};
  rock.list = VerletList(1e-4, 1e-3);
  for (int k = 0; k < 6; ++k) {
    Body b;
    b.R = 0.01;
    b.x = {0.0199 * k, 0.00999, 0.00995};
    b.m = sphere_mass(b.R, 2500.0);
    b.v = {0.01 * k, 0.003, -0.02};
    b.omega = {0.0, 1.0 + k, 0.0};
    rock.particles.add(b);
  }
  rock.bonds = make_bonds(rock.particles, rock.cell, {{0, 1, {}}, {1, 2, {}}, {2, 3, {}}});
  PlaneWall floor;
  floor.material = rock.material.contact;
  floor.plane.v = {0.001, 0.0, 0.0};
  rock.planes.push_back(floor);
  rock.mirrors.emplace_back();
  bond_to_mirror(rock.mirrors.front(), rock.particles, 1e-3);
  rock.walls.push_back(
      make_wall({{-0.00998, -0.1, -0.1}, {-0.00998, 0.2, -0.1}, {-0.00998, 0.0, 0.2}},
                {{0, 1, 2}}, rock.material.contact));
  rock.walls.front().v = {{1e-3, 0, 0}, {2e-3, 0, 0}, {0, 1e-3, 0}};
  bond_to_wall(rock.walls.front(), rock.particles, 1e-3);
  PileWall pile;
  pile.pile.R = 0.004;
  pile.pile.cone_height = 0.004;
  pile.pile.x_axis = 0.06;
  pile.pile.y_axis = 0.0105;
  pile.pile.z_tip = 0.0199;
  pile.pile.v_z = -0.05;
  pile.material = rock.material.contact;
  rock.piles.push_back(pile);
  add_forces(rock, 0.0);
  return rock;
}

/// One step of it: pile, wall and floor go on at their velocities.
inline void step_with_everything(Rock& rock, double dt)
{
  advance(rock, dt, dt, [&](double h) {
    rock.piles.front().pile.z_tip += h * rock.piles.front().pile.v_z;
    for (std::size_t k = 0; k < 3; ++k)
      rock.walls.front().x[k] += h * rock.walls.front().v[k];
    rock.planes.front().plane.point += h * rock.planes.front().plane.v;
  });
}

} // namespace mergel::dem::test
