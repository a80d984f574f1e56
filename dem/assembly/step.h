/// One DEM step, and the state that it moves.
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

/// A rigid plane and the spheres at it.
struct PlaneWall {
  Plane plane;
  LinearMaterial material;
  SurfaceContacts contacts;
  VectorSum force; ///< on the plane in the last step, of all ranks [N]
};

/// The pile and the spheres at it.
struct PileWall {
  Pile pile;
  LinearMaterial material;
  SurfaceContacts contacts;
  PileLoad load; ///< in the last step, of all ranks
};

/// A bonded rock with everything that acts on it. What a run does not have is an empty
/// list.
///
/// On several ranks each holds all grains, and of bonds, contacts and walls what touches its
/// own (distribute.h). Losses and works are of owned grains, but for wall_work, pile_work and
/// cell_work, which every rank knows in full.
struct Rock {
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
  EnergySum wall_work; ///< done on the rock by planes and triangulated walls that move [J]
  EnergySum pile_work; ///< done on the rock by the pile [J]
  EnergySum cell_work; ///< done on the rock by a driven cell [J]
  ExactVector<EnergySum> virial; ///< of a driven cell in the last step, of all ranks [J]
  Fault fault;                   ///< of this rank, of which the others do not know yet
  StepTimes times;
};

/// Forces at the present positions, from histories carried over the step dt [s] that ends
/// now. Ghosts follow their owners first; lists are rebuilt when they are stale. Collective,
/// as is all below.
/// @throws Unstable naming the particle, on all ranks alike, when a force or a place cannot
///   be; on several ranks, of a rock without walls and driven cell, in the next advance()
void add_forces(Rock& rock, double dt);

/// Make all lists anew for the present positions, whatever their age: it changes no force.
void rebuild_lists(Rock& rock);

/// kick, drift, move the walls by `move_walls(dt)`, strain a driven cell, forces.
///
/// The walls hold v^{n-1/2} before and v^{n+1/2} after move_walls, which also moves them to
/// x^{n+1}; it may set the rate of the cell too.
/// @param dt_before the step before [s]; the kick uses the mean of both
/// @throws Unstable naming the particle that moves or turns too far, and as
///   add_forces(), on all ranks alike
template <class MoveWalls>
void advance(Rock& rock, double dt_before, double dt, MoveWalls&& move_walls);

/// The stable step of the rock as it is, walls included [s].
double stable_time_step(const Rock& rock, double safety);

/// Unbalanced-force ratio of the rock [-].
double unbalanced_ratio(const Rock& rock);

/// @throws Unstable naming the particles when two grains overlap by more than half of the
///   smaller radius
void check_overlaps(const Rock& rock);

/// Power of the wall forces of the last step on the rock, at the present wall velocities
/// [W].
struct WallPower {
  double walls = 0.0, pile = 0.0;
};
WallPower wall_power(const Rock& rock);

/// Power of a driven cell on the rock, from the virial of the last step at the present rate
/// [W]; 0 of any other.
double cell_power(const Rock& rock);

template <class MoveWalls>
void advance(Rock& rock, double dt_before, double dt, MoveWalls&& move_walls)
{
  const double start = wall_clock();
  const double dt_kick = 0.5 * (dt_before + dt);
  double most = std::numeric_limits<double>::infinity(); // stays so where a fault is met
  rock.fault.watch(
      [&] { most = kick_and_drift(rock.particles, rock.motion, dt_kick, dt, rock.work); });
  const double moved = wall_clock();
  rock.times.motion += moved - start;
  const double most_of_all = rock.comm.global_max(most);
  if (std::isinf(most_of_all)) rock.comm.agree_on(rock.fault);
  rock.list.add_motion(most_of_all);
  rock.times.exchange += wall_clock() - moved;
  // Work of the forces at t^n on the mean motion of the walls around t^n.
  const WallPower before = wall_power(rock);
  const double cell_before = cell_power(rock);
  move_walls(dt);
  const WallPower after = wall_power(rock);
  rock.wall_work.add(0.5 * dt_kick * (before.walls + after.walls));
  rock.pile_work.add(0.5 * dt_kick * (before.pile + after.pile));
  if (rock.cell.is_driven) {
    rock.cell_work.add(0.5 * dt_kick * (cell_before + cell_power(rock)));
    rock.list.add_strain(strain(rock.cell, dt, rock.particles));
  }
  add_forces(rock, dt);
}

} // namespace mergel::dem
