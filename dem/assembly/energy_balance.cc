#include "dem/assembly/energy_balance.h"

#include "dem/pairs/pair_sums.h"

#include <cmath>

namespace mergel::dem {

EnergyBalance energy_balance(const Assembly& assembly, double dt)
{
  EnergyBalance e;
  const PairMaterials& material = assembly.material;
  const Particles& p = assembly.particles;
  KickWork work = assembly.work;
  EnergySum kinetic = kinetic_energy_after_kick(p, assembly.motion, 0.5 * dt, work), walls,
            mirror, wall_work;
  PairSums pairs = sum_pairs(material, assembly.cell, p, assembly.bonds, assembly.contacts);
  for (const Mirror& m : assembly.mirrors) mirror += stored_energy(m, material, p);
  for (const Wall& w : assembly.walls) walls += stored_energy(w, material, p);
  for (const RigidWall& w : assembly.rigid_walls) walls += stored_energy(w, p);
  for (const Wall& w : assembly.walls) {
    if (!w.f.is_shared() && assembly.comm.rank() > 0) continue; // the total on every rank
    wall_work += w.work;
    wall_work += work_over(w, 0.5 * dt);
  }
  PairLosses losses = assembly.losses;
  ExactReduction sums;
  for (EnergySum* s :
       {&kinetic, &pairs.bonds, &pairs.contacts, &walls, &mirror, &wall_work})
    sums.add(*s);
  const auto add = [&](const char*, SumKind, EnergySum& s) { sums.add(s); };
  visit_sums(losses, add);
  visit_sums(work, add);
  sums.run(assembly.comm);
  e.kinetic = kinetic.value();
  e.bonds = pairs.bonds.value();
  e.contacts = pairs.contacts.value();
  e.mirror = mirror.value();
  e.walls = walls.value();

  e.gravity = work.gravity.value();
  e.wall_work = wall_work.value();
  for (const RigidWall& w : assembly.rigid_walls)
    e.rigid_wall_work += w.work.value() + 0.5 * dt * power(w);
  e.cell_work = assembly.cell_work.value() + 0.5 * dt * cell_power(assembly);

  e.slip = losses.slip.value();
  e.plastic = losses.plastic.value();
  e.breakage_release = losses.breakage_release.value();
  e.rotation_constraint = work.rotation_constraint.value();
  e.damping = work.damping.value();
  return e;
}

bool EnergyAlarm::add(double error, double time, double input, double stored_at_start)
{
  if (!(input > 10.0 * stored_at_start)) return false;
  const double size = std::abs(error);
  constexpr double stops = 1e-2; // beyond it the run stops with a message of its own
  if (!(size <= stops)) return false;
  const bool is_large = size > large;
  const bool rises = before > 0.0 && size > noise && size > rise * before;
  before = size;
  if (is_raised() || !(is_large || rises)) return false;
  first_error = size;
  first_time = time;
  return true;
}

double unexplained(const EnergyBalance& now, const EnergyBalance& start)
{
  return (now.stored() - start.stored()) - (now.input() - start.input()) +
         (now.lost() - start.lost());
}

} // namespace mergel::dem
