/// The assembly: the bonded particles of a run and everything that acts on them.
#pragma once

#include "dem/pairs/neighbours.h"
#include "dem/parallel/ghosts.h"
#include "dem/parallel/reduction.h"
#include "dem/particles/integrate.h"
#include "dem/timer.h"
#include "dem/walls/mirror.h"
#include "dem/walls/rigid_wall.h"
#include "dem/walls/triangulated.h"

#include <string>

namespace mergel::dem {

/// What a run does not have is an empty list.
///
/// On several ranks each holds an entry for all particles, but only those bonds, contacts
/// and wall contacts that have an owned particle (distribute.h). Losses and works are those
/// of the owned particles, except those of walls and cell: these are totals on every rank, but
/// for triangulated walls whose nodal forces are shared (NodalSums::share).
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
  std::vector<Wall> walls;     ///< triangulated
  std::vector<RigidWall> rigid_walls;

  PairLosses losses;
  KickWork work;
  EnergySum cell_work; ///< on the particles by a strain-controlled cell [J]
  /// Of a strain-controlled cell in the last step, of all ranks [J].
  ExactVector<EnergySum> virial;
  Fault fault; ///< of this rank, not yet reported to the others
  StepTimes times;
};

/// Show each wall to `visit(wall)`: mirrors, triangulated walls, rigid walls, in the order
/// in which their forces are added. What a wall of any kind can do is a function of the
/// same name beside each kind: rebuild_wall(), add_wall_forces(), travel(),
/// histories(), visit_sums(), save_wall() and load_wall().
template <class AnyAssembly, class Visit>
void for_each_wall(AnyAssembly& assembly, Visit&& visit)
{
  for (auto& w : assembly.mirrors) visit(w);
  for (auto& w : assembly.walls) visit(w);
  for (auto& w : assembly.rigid_walls) visit(w);
}

/// The walls of two copies of an assembly, in pairs.
template <class AnyAssembly, class Visit>
void for_each_wall(AnyAssembly& a, Assembly& b, Visit&& visit)
{
  for (std::size_t k = 0; k < a.mirrors.size(); ++k) visit(a.mirrors[k], b.mirrors[k]);
  for (std::size_t k = 0; k < a.walls.size(); ++k) visit(a.walls[k], b.walls[k]);
  for (std::size_t k = 0; k < a.rigid_walls.size(); ++k)
    visit(a.rigid_walls[k], b.rigid_walls[k]);
}

/// Show each wall with its name in files, mirror0, wall0, rigid0 and so on, to
/// `visit(name, wall)`, in the same order.
template <class AnyAssembly, class Visit>
void for_each_named_wall(AnyAssembly& assembly, Visit&& visit)
{
  const auto all = [&](const char* kind, auto& walls) {
    for (std::size_t k = 0; k < walls.size(); ++k)
      visit(kind + std::to_string(k), walls[k]);
  };
  all("mirror", assembly.mirrors);
  all("wall", assembly.walls);
  all("rigid", assembly.rigid_walls);
}

/// Show every exact sum of an assembly, with its name, to `visit(name, kind, sum)`: the one
/// list of them, for the sums over ranks, the checkpoint and the energy balance.
template <class AnyAssembly, class Visit>
requires std::same_as<std::remove_const_t<AnyAssembly>, Assembly>
void visit_sums(AnyAssembly& assembly, Visit&& visit)
{
  visit_sums(assembly.losses, visit);
  visit_sums(assembly.work, visit);
  visit("cell_work", SumKind::total, assembly.cell_work);
  visit("virial", SumKind::total, assembly.virial);
  for_each_named_wall(assembly, [&](const std::string& wall_name, auto& wall) {
    visit_sums(wall, [&](const char* name, SumKind kind, auto& sum) {
      visit((wall_name + '_' + name).c_str(), kind, sum);
    });
  });
}

} // namespace mergel::dem
