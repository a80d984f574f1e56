/// One DEM step, and the assembly that it advances.
#pragma once

#include "dem/assembly/timestep.h"
#include "dem/pairs/neighbours.h"
#include "dem/parallel/ghosts.h"
#include "dem/parallel/reduction.h"
#include "dem/particles/integrate.h"
#include "dem/timer.h"
#include "dem/walls/mirror.h"
#include "dem/walls/surfaces.h"
#include "dem/walls/triangulated.h"

#include <cmath>
#include <limits>
#include <optional>

namespace mergel::dem {

/// A rigid plane and its contacts.
struct PlaneWall {
  Plane plane;
  LinearMaterial material;
  SurfaceContacts contacts;
  VectorSum force; ///< on the plane in the last step, of all ranks [N]
};

/// The pile and its contacts.
struct PileWall {
  Pile pile;
  LinearMaterial material;
  SurfaceContacts contacts;
  PileLoad load; ///< in the last step, of all ranks
};

/// The bonded particles of a run and everything that acts on them. What a run does not have
/// is an empty list.
///
/// On several ranks each holds an entry for all particles, but only those bonds, contacts
/// and wall contacts that have an owned particle (distribute.h). Losses and works are those
/// of the owned particles, except wall_work, pile_work and cell_work: these are totals on
/// every rank.
struct Assembly {
  Communicator comm;
  Partition partition;
  Ghosts ghosts;
  Particles particles;
  PeriodicCell cell;
  Bonds bonds;
  Contacts contacts;
  PairMaterials material;
  Motion motion;
  VerletList list{0.0, 0.0};

  std::vector<Mirror> mirrors; ///< none or one, the cut y = 0
  std::vector<PlaneWall> planes;
  std::vector<Wall> walls; ///< triangulated
  std::vector<PileWall> piles;
  bool wall_bonds_yield = false;

  PairLosses losses;
  KickWork work;
  EnergySum wall_work; ///< on the particles by moving planes and triangulated walls [J]
  EnergySum pile_work; ///< on the particles by the pile [J]
  EnergySum cell_work; ///< on the particles by a strain-controlled cell [J]
  /// Of a strain-controlled cell in the last step, of all ranks [J].
  ExactVector<EnergySum> virial;
  Fault fault; ///< of this rank, not yet reported to the others
  StepTimes times;
};

/// Forces at the present positions; histories are updated over the step dt [s] that ends
/// now. Ghosts are updated first, and stale lists are rebuilt. Collective, as is all below.
/// @throws Unstable naming the particle, on all ranks alike, when a force or a position is
///   not possible. On several ranks without walls and strain-controlled cell this happens
///   in the next advance().
void add_forces(Assembly& assembly, double dt);

/// Rebuild all lists for the present positions, stale or not. Changes no force.
void rebuild_lists(Assembly& assembly);

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

/// Stable step of the assembly in its present state, walls included [s].
double stable_time_step(const Assembly& assembly, double safety);

/// Unbalanced-force ratio of the assembly [-].
double unbalanced_ratio(const Assembly& assembly);

/// @throws Unstable naming the two particles that overlap by more than half of the smaller
///   radius
void check_overlaps(const Assembly& assembly);

/// Power of the wall forces of the last step on the particles, at the present wall
/// velocities [W].
struct WallPower {
  double walls = 0.0, pile = 0.0;
};
WallPower wall_power(const Assembly& assembly);

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
    largest_motion =
        kick_and_drift(assembly.particles, assembly.motion, dt_kick, dt, assembly.work);
  });
  const double moved = wall_clock();
  assembly.times.motion += moved - start;
  const double global_largest = assembly.comm.global_max(largest_motion);
  if (std::isinf(global_largest)) assembly.comm.agree_on(assembly.fault);
  assembly.list.add_motion(global_largest);
  assembly.times.exchange += wall_clock() - moved;
  // Work of the forces at t^n on the mean motion of the walls around t^n.
  const WallPower before = wall_power(assembly);
  const double cell_before = cell_power(assembly);
  move_walls(dt);
  const WallPower after = wall_power(assembly);
  assembly.wall_work.add(0.5 * dt_kick * (before.walls + after.walls));
  assembly.pile_work.add(0.5 * dt_kick * (before.pile + after.pile));
  if (assembly.cell.is_strain_controlled) {
    assembly.cell_work.add(0.5 * dt_kick * (cell_before + cell_power(assembly)));
    assembly.list.add_strain(strain(assembly.cell, dt, assembly.particles));
  }
  add_forces(assembly, dt);
}

} // namespace mergel::dem
