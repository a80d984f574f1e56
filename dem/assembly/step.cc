#include "dem/assembly/step.h"
#include "dem/timer.h"

#include <algorithm>

namespace mergel::dem {

namespace {

/// Those of others that our pairs reach become our ghosts.
void choose_ghosts(Rock& rock)
{
  if (rock.comm.is_alone()) return;
  std::vector<char> is_needed(rock.particles.size(), 0);
  for (const auto* pairs : {&rock.bonds.pairs, &rock.contacts.pairs})
    for (const Pair& q : *pairs) is_needed[q.i] = is_needed[q.j] = 1;
  rock.ghosts.choose(rock.particles, is_needed, rock.partition, rock.comm);
}

/// What acts on walls and on a driven cell, from all ranks; and, in the same message, whether
/// one of them has met a fault.
void sum_over_ranks(Rock& rock)
{
  if (rock.cell.is_driven) rock.virial = rock.losses.virial;
  if (rock.comm.is_alone()) return rock.comm.agree_on(rock.fault);
  ExactReduction sums;
  for (PlaneWall& w : rock.planes) sums.add(w.force);
  for (Wall& w : rock.walls)
    for (VectorSum& f : w.f) sums.add(f);
  for (PileWall& w : rock.piles) {
    sums.add(w.load.cone);
    sums.add(w.load.shaft);
  }
  if (rock.cell.is_driven) sums.add(rock.virial);
  if (sums.is_empty()) return; // a fault waits for the next step
  ForceSum n_faults;
  if (rock.fault.is_met()) n_faults.add(1.0);
  sums.add(n_faults);
  sums.run(rock.comm);
  if (n_faults.value() > 0.0) rock.comm.agree_on(rock.fault);
}

/// Half of the skin belongs to the particles, half to the walls. The same on all ranks.
bool lists_are_stale(Rock& rock)
{
  if (rock.list.may_be_stale(rock.particles) &&
      rock.list.is_stale(rock.comm.global_max(rock.list.travel(rock.particles))))
    return true;
  const double allowed = rock.list.wall_allowance();
  for (const PlaneWall& w : rock.planes)
    if (w.contacts.has_moved(w.plane.point, allowed)) return true;
  for (const Wall& w : rock.walls)
    if (travel(w) > allowed) return true;
  for (const PileWall& w : rock.piles)
    if (w.contacts.has_moved(w.pile.tip(), allowed)) return true;
  return false;
}

} // namespace

void rebuild_lists(Rock& rock)
{
  rock.partition.gather_motion(rock.particles, rock.comm);
  const Particles& p = rock.particles;
  const double skin = rock.list.skin();
  rock.list.rebuild(p, rock.cell, rock.bonds, rock.contacts);
  rock.fault.watch([&] {
    for (Mirror& m : rock.mirrors) rebuild_mirror(m, p, rock.material.contact.g_a, skin);
    for (PlaneWall& w : rock.planes)
      w.contacts.rebuild(p, w.material.g_a, skin, w.plane.point,
                         [&](const Body& b) { return w.plane.touch(b).gap; });
    for (Wall& w : rock.walls) rebuild_wall(w, p, skin);
    for (PileWall& w : rock.piles)
      w.contacts.rebuild(p, w.material.g_a, skin, w.pile.tip(),
                         [&](const Body& b) { return w.pile.meet(b).touch.gap; });
  });
  choose_ghosts(rock);
}

namespace {

/// The forces on our grains, and of them on walls.
template <class Lap>
void add_own_forces(Rock& rock, double dt, Lap&& lap)
{
  Particles& p = rock.particles;
  add_bond_forces(rock.material, rock.cell, dt, p, rock.bonds, rock.losses);
  lap(rock.times.bonds);
  add_contact_forces(rock.material.contact, rock.cell, dt, p, rock.contacts, rock.losses);
  lap(rock.times.contacts);

  for (Mirror& m : rock.mirrors) add_mirror_forces(rock.material, dt, p, m, rock.losses);
  for (PlaneWall& w : rock.planes)
    w.force = add_plane_forces(w.material, w.plane, dt, p, w.contacts, rock.losses);
  for (Wall& w : rock.walls)
    add_wall_forces(rock.material.bond, rock.wall_bonds_yield, dt, p, w, rock.losses);
  for (PileWall& w : rock.piles)
    w.load = add_pile_forces(w.material, w.pile, dt, p, w.contacts, rock.losses);
  for (const Mirror& m : rock.mirrors) hold_mirror_spin(m, p);
  lap(rock.times.walls);
}

} // namespace

void add_forces(Rock& rock, double dt)
{
  Particles& p = rock.particles;
  double from = wall_clock();
  const auto lap = [&from](double& part) {
    const double to = wall_clock();
    part += to - from;
    from = to;
  };
  rock.ghosts.update(p, rock.comm);
  lap(rock.times.exchange);
  for (Wall& w : rock.walls) update_normals(w);
  if (lists_are_stale(rock)) rebuild_lists(rock); // walls are the same on all ranks
  clear_loads(p);
  rock.losses.virial.clear();
  lap(rock.times.lists);

  rock.fault.watch([&] { add_own_forces(rock, dt, lap); });
  sum_over_ranks(rock);
  lap(rock.times.exchange);
}

double stable_time_step(const Rock& rock, double safety)
{
  const Particles& p = rock.particles;
  StiffnessSums s = stiffness_sums(rock.material, rock.cell, p, rock.bonds, rock.contacts);
  for (const Mirror& m : rock.mirrors) add_mirror_stiffness(s, rock.material, p, m);
  for (const PlaneWall& w : rock.planes)
    add_surface_stiffness(s, w.material, p, w.contacts);
  for (const Wall& w : rock.walls) add_wall_stiffness(s, rock.material.bond, p, w);
  for (const PileWall& w : rock.piles) add_surface_stiffness(s, w.material, p, w.contacts);
  return rock.comm.global_min(time_step(s, p, safety, rock.motion));
}

double unbalanced_ratio(const Rock& rock)
{
  ForceSum resultants = sum_of_resultants(rock.particles, rock.motion);
  ForceSum forces = sum_of_pair_forces(rock.particles, rock.material, rock.cell, rock.bonds,
                                       rock.contacts);
  ExactReduction sums;
  sums.add(resultants);
  sums.add(forces);
  sums.run(rock.comm);
  return forces.value() > 0.0 ? resultants.value() / forces.value() : 0.0;
}

void check_overlaps(const Rock& rock)
{
  const auto check = [&](const Pair& q) {
    const Body &i = rock.particles.body[q.i], &j = rock.particles.body[q.j];
    const double r = std::min(i.R, j.R);
    const double overlap = i.R + j.R - (j.x + rock.cell.offset(q.shift) - i.x).norm();
    if (!(overlap <= 0.5 * r))
      throw NumericalError(
          "particles " + std::to_string(rock.particles.id[q.i]) + " and " +
          std::to_string(rock.particles.id[q.j]) + " overlap by " +
          std::to_string(overlap / r) +
          " of the smaller radius (at most 0.5): the contact is too soft for "
          "this load");
  };
  Fault fault = rock.fault; // may have waited for this
  fault.watch([&] {
    for (const Pair& q : rock.bonds.pairs) check(q);
    for (const Pair& q : rock.contacts.pairs) check(q);
  });
  rock.comm.agree_on(fault);
}

WallPower wall_power(const Rock& rock)
{
  WallPower power;
  for (const PlaneWall& w : rock.planes) power.walls -= w.force.value().dot(w.plane.v);
  for (const Wall& w : rock.walls)
    for (std::size_t k = 0; k < w.f.size(); ++k) power.walls -= w.f[k].value().dot(w.v[k]);
  for (const PileWall& w : rock.piles)
    power.pile -= (w.load.cone.z.value() + w.load.shaft.z.value()) * w.pile.v_z;
  return power;
}

double cell_power(const Rock& rock)
{
  return rock.cell.is_driven ? rock.virial.value().dot(rock.cell.rate) : 0.0;
}

} // namespace mergel::dem
