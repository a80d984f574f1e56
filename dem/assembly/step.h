/// One DEM step.
#pragma once

#include "dem/assembly/assembly.h"

#include <cmath>
#include <limits>

namespace mergel::dem {

/// Forces at the present positions; histories are updated over the step dt [s] that ends
/// now. Ghosts are updated first, and stale lists are rebuilt. Collective, as is all below.
/// @throws Unstable naming the particle, on all ranks alike, when a force or a position is
///   not possible. On several ranks without walls and strain-controlled cell this happens
///   in the next advance().
void add_forces(Assembly& assembly, double dt);
/// The same where kick_and_drift() has left the loads at zero.
void add_forces_to_cleared(Assembly& assembly, double dt);

/// Rebuild all lists for the present positions, stale or not. Changes no force.
/// @param dt time step, as of VerletList::rebuild() [s]
void rebuild_lists(Assembly& assembly, double dt = 0.0);

/// Rebuild the lists unless they have all pairs and all contacts with walls whose gap is
/// below (g_a + beyond) S. Changes no force. Collective.
/// @param beyond at S = 1, below the skin [m]; @param dt as of rebuild_lists() [s]
void complete_lists(Assembly& assembly, double beyond, double dt = 0.0);

/// One step: kick, drift, move the walls by `move_walls(dt)`, strain a strain-controlled
/// cell, forces (dem/README.md, Motion).
///
/// `move_walls` moves the walls to x^{n+1} and sets their velocities from v^{n-1/2} to
/// v^{n+1/2}; it may also set the strain rate of the cell.
/// @param dt_before the previous step [s]; the kick uses the mean of both steps
/// @throws Unstable, on all ranks alike, naming the particle that moves or rotates too far,
///   and as add_forces()
template <class MoveWalls>
void advance(Assembly& assembly, double dt_before, double dt, MoveWalls&& move_walls);

/// Unbalanced-force ratio of the assembly [-].
double unbalanced_ratio(const Assembly& assembly);

/// Add to the works of the walls that of the forces of the last step over dt [s], at the present
/// wall velocities.
void add_wall_work(Assembly& assembly, double dt);

/// Power of a strain-controlled cell on the particles, from the virial of the last step at
/// the present strain rate [W]; 0 for any other cell.
double cell_power(const Assembly& assembly);

template <class MoveWalls>
void advance(Assembly& assembly, double dt_before, double dt, MoveWalls&& move_walls)
{
  const double start = wall_clock();
  const double dt_kick = 0.5 * (dt_before + dt);
  double largest_motion =
      std::numeric_limits<double>::infinity(); // stays infinite after a fault
  assembly.fault.run([&] {
    largest_motion = kick_and_drift(assembly.particles, assembly.motion, dt_kick, dt,
                                    assembly.work, assembly.list.spare());
  });
  const double moved = wall_clock();
  assembly.times.motion += moved - start;
  const double global_largest = assembly.comm.global_max(largest_motion);
  if (std::isinf(global_largest)) assembly.comm.agree_on(assembly.fault);
  assembly.list.add_motion(global_largest);
  assembly.times.exchange += wall_clock() - moved;
  // Work of the forces at t^n on the mean motion of the walls around t^n.
  add_wall_work(assembly, 0.5 * dt_kick);
  const double cell_before = cell_power(assembly);
  move_walls(dt);
  add_wall_work(assembly, 0.5 * dt_kick);
  if (assembly.cell.is_strain_controlled) {
    assembly.cell_work.add(0.5 * dt_kick * (cell_before + cell_power(assembly)));
    assembly.list.add_strain(strain(assembly.cell, dt, assembly.particles));
  }
  add_forces_to_cleared(assembly, dt);
}

} // namespace mergel::dem
