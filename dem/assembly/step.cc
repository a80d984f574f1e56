#include "dem/assembly/step.h"
#include "dem/pairs/pair_sums.h"
#include "dem/timer.h"

namespace mergel::dem {

namespace {

/// The remote particles of this rank's pairs become its ghosts.
void choose_ghosts(Assembly& assembly)
{
  if (assembly.comm.is_alone()) return;
  std::vector<char> is_needed(assembly.particles.size(), 0);
  for (const auto* pairs : {&assembly.bonds.pairs, &assembly.contacts.pairs})
    for (const Pair& q : *pairs) is_needed[q.i] = is_needed[q.j] = 1;
  assembly.ghosts.choose(assembly.particles, is_needed, assembly.partition, assembly.comm);
}

/// Sum the forces on walls and the virial of a strain-controlled cell over all ranks. The
/// same message tells whether a rank has found a fault.
void sum_over_ranks(Assembly& assembly)
{
  if (assembly.cell.is_strain_controlled) assembly.virial = assembly.losses.virial;
  if (assembly.comm.is_alone()) return assembly.comm.agree_on(assembly.fault);
  ExactReduction sums;
  for_each_wall(assembly, [&](auto& wall) {
    visit_sums(wall, [&](const char*, SumKind kind, auto& sum) {
      if (kind == SumKind::forces || kind == SumKind::by_node) sums.add(sum);
    });
  });
  if (assembly.cell.is_strain_controlled) sums.add(assembly.virial);
  if (sums.is_empty()) return; // a fault is then reported in the next step
  ForceSum n_faults;
  if (assembly.fault.is_set()) n_faults.add(1.0);
  sums.add(n_faults);
  sums.run(assembly.comm);
  if (n_faults.value() > 0.0) assembly.comm.agree_on(assembly.fault);
}

/// Particles may move by half of the skin, walls by the other half. The same on all ranks.
bool lists_are_stale(Assembly& assembly)
{
  if (assembly.list.may_be_stale(assembly.particles) &&
      assembly.list.is_stale(
          assembly.comm.global_max(assembly.list.travel(assembly.particles))))
    return true;
  const double allowed = assembly.list.wall_allowance();
  bool is_stale = false;
  for_each_wall(assembly, [&](const auto& w) { is_stale |= travel(w) > allowed; });
  return is_stale;
}

} // namespace

void rebuild_lists(Assembly& assembly, double dt)
{
  assembly.partition.gather_motion(assembly.particles, assembly.comm);
  const Particles& p = assembly.particles;
  const double skin = assembly.list.skin();
  assembly.list.rebuild(p, assembly.cell, assembly.bonds, assembly.contacts, dt);
  assembly.fault.run([&] {
    for_each_wall(assembly, [&](auto& w) {
      rebuild_wall(w, assembly.material, p, skin, assembly.list.extra());
    });
  });
  choose_ghosts(assembly);
}

void complete_lists(Assembly& assembly, double beyond, double dt)
{
  assembly.comm.agree_on(assembly.fault); // one of the last step may not be reported yet
  const double largest = assembly.comm.global_max(assembly.list.travel(assembly.particles));
  bool is_complete = assembly.list.is_complete_to(beyond, largest);
  // Of the half of the skin that belongs to walls they may use the same share.
  const double share = 1.0 - beyond / assembly.list.skin();
  for_each_wall(assembly, [&](const auto& w) {
    is_complete &= travel(w) <= share * assembly.list.wall_allowance();
  });
  if (is_complete) return;
  rebuild_lists(assembly, dt);
  assembly.comm.agree_on(assembly.fault);
}

namespace {

/// Forces on owned particles, and their reactions on walls.
template <class Lap>
void add_own_forces(Assembly& assembly, double dt, Lap&& lap)
{
  Particles& p = assembly.particles;
  add_bond_forces(assembly.material, assembly.cell, dt, p, assembly.bonds, assembly.losses);
  lap(assembly.times.bonds);
  add_contact_forces(assembly.material.contact, assembly.cell, dt, p, assembly.contacts,
                     assembly.losses);
  lap(assembly.times.contacts);

  for_each_wall(assembly, [&](auto& w) {
    add_wall_forces(w, assembly.material, dt, p, assembly.losses);
  });
  for (const Mirror& m : assembly.mirrors) constrain_mirror_spin(m, p);
  lap(assembly.times.walls);
}

} // namespace

void add_forces(Assembly& assembly, double dt)
{
  clear_loads(assembly.particles);
  add_forces_to_cleared(assembly, dt);
}

void add_forces_to_cleared(Assembly& assembly, double dt)
{
  Particles& p = assembly.particles;
  double from = wall_clock();
  const auto lap = [&from](double& part) {
    const double to = wall_clock();
    part += to - from;
    from = to;
  };
  assembly.ghosts.update(p, assembly.comm);
  lap(assembly.times.exchange);
  if (lists_are_stale(assembly))
    rebuild_lists(assembly, dt); // walls are the same on all ranks
  if (assembly.list.is_narrowing_stale(assembly.contacts))
    assembly.list.narrow(p, assembly.cell, assembly.contacts);
  assembly.losses.virial.clear();
  lap(assembly.times.lists);

  assembly.fault.run([&] { add_own_forces(assembly, dt, lap); });
  sum_over_ranks(assembly);
  lap(assembly.times.exchange);
}

double unbalanced_ratio(const Assembly& assembly)
{
  ForceSum resultants = sum_of_resultants(assembly.particles, assembly.motion);
  ForceSum forces = sum_pairs(assembly.material, assembly.cell, assembly.particles,
                              assembly.bonds, assembly.contacts)
                        .forces;
  ExactReduction sums;
  sums.add(resultants);
  sums.add(forces);
  sums.run(assembly.comm);
  return forces.value() > 0.0 ? resultants.value() / forces.value() : 0.0;
}

void add_wall_work(Assembly& assembly, double dt)
{
  for (Wall& w : assembly.walls) {
    const auto add = [&] { w.work += work_over(w, dt); };
    if (w.f.is_shared()) // other ranks may find no fault
      assembly.fault.run(add);
    else
      add();
  }
  for (RigidWall& w : assembly.rigid_walls) w.work.add(dt * power(w));
}

double cell_power(const Assembly& assembly)
{
  return assembly.cell.is_strain_controlled
             ? assembly.virial.value().dot(assembly.cell.rate)
             : 0.0;
}

} // namespace mergel::dem
