#include "dem/assembly/energy_balance.h"

namespace mergel::dem {

EnergyBalance energy_balance(const Assembly& assembly, double dt)
{
  EnergyBalance e;
  Particles now = assembly.particles;
  KickWork work = assembly.work;
  kick(now, assembly.motion, 0.5 * dt, work);
  EnergySum kinetic = kinetic_energy_sum(now), walls, mirror;
  PairEnergy pairs = pair_energy(assembly.material, assembly.cell, assembly.particles,
                                 assembly.bonds, assembly.contacts);
  for (const Mirror& m : assembly.mirrors) mirror += m.energy;
  for (const PlaneWall& w : assembly.planes) walls += w.contacts.energy();
  for (const Wall& w : assembly.walls) walls += w.energy();
  for (const PileWall& w : assembly.piles) walls += w.contacts.energy();
  PairLosses losses = assembly.losses;
  ExactReduction sums;
  for (EnergySum* s : {&kinetic, &pairs.bonds, &pairs.contacts, &walls, &mirror,
                       &work.gravity, &work.damping, &work.rotation_constraint,
                       &losses.slip, &losses.plastic, &losses.breakage_release})
    sums.add(*s);
  sums.run(assembly.comm);
  e.kinetic = kinetic.value();
  e.bonds = pairs.bonds.value();
  e.contacts = pairs.contacts.value();
  e.mirror = mirror.value();
  e.walls = walls.value();

  const WallPower power = wall_power(assembly);
  e.gravity = work.gravity.value();
  e.wall_work = assembly.wall_work.value() + 0.5 * dt * power.walls;
  e.pile_work = assembly.pile_work.value() + 0.5 * dt * power.pile;
  e.cell_work = assembly.cell_work.value() + 0.5 * dt * cell_power(assembly);

  e.slip = losses.slip.value();
  e.plastic = losses.plastic.value();
  e.breakage_release = losses.breakage_release.value();
  e.rotation_constraint = work.rotation_constraint.value();
  e.damping = work.damping.value();
  return e;
}

double unexplained(const EnergyBalance& now, const EnergyBalance& start)
{
  return (now.stored() - start.stored()) - (now.input() - start.input()) +
         (now.lost() - start.lost());
}

} // namespace mergel::dem
