#include "coupling/coupled_system.h"

#include "dem/assembly/distribute.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mergel::coupling {

CoupledSystem::CoupledSystem(const CoupledSpec& spec, std::vector<StructureSpec>& specs)
    : is_smooth_while_held(spec.is_smooth_while_held), step_spec(spec.step),
      mass_scaling(spec.mass_scaling), largest_subcycle(spec.largest_subcycle)
{
  assembly.material = spec.material;
  assembly.motion = spec.motion;
  assembly.list = dem::VerletList(dem::activation_gap(spec.material.contact), spec.skin);
  if (spec.symmetry != SymmetryPlane::none) assembly.mirrors.emplace_back();
  for (StructureSpec& s : specs) {
    Interface interface = s.structure->interface(s.contact);
    Structure& structure = *s.structure;
    structures.push_back({s.name, std::move(s.structure), assembly.walls.size(),
                          Exchange(std::move(interface.transfer), structure)});
    assembly.walls.push_back(std::move(interface.wall));
    assembly.walls.back().bonds_yield = s.bonds_yield;
    const dem::NodeShares shares = structure.shares();
    if (shares.are_shared() && !structures.back().exchange.transfer().is_identity())
      throw std::logic_error(
          "nodes of a structure are shared that are not those of its wall");
    assembly.walls.back().f.share(shares);
  }
}

CoupledSystem::CoupledSystem(const CoupledSpec& spec, std::vector<StructureSpec> specs,
                             const dem::Particles& particles, const dem::Bonding& bonding,
                             MPI_Comm comm)
    : CoupledSystem(spec, specs)
{
  assembly.particles = particles;
  assembly.bonds = dem::make_bonds(assembly.particles, assembly.cell, bonding.pairs);
  if (spec.symmetry == SymmetryPlane::bonded)
    dem::bond_to_mirror(assembly.mirrors.front(), assembly.particles, bonding.limit);
  for (std::size_t k = 0; k < specs.size(); ++k)
    if (specs[k].is_bonded)
      dem::bond_to_wall(assembly.walls[k], assembly.particles, bonding.limit);
  dem::distribute(assembly, comm);
  dem::add_forces(assembly, 0.0); // at dt = 0 histories do not change
  dem::scale_masses(assembly, mass_scaling);
  find_time_step();
  dt_before = dt;
}

StructureSystem CoupledSystem::structure_system() const
{
  std::vector<StructureSystem::Part> parts;
  for (const Member& s : structures)
    if (moves(s)) parts.push_back({s.structure.get(), &s.exchange.transfer(), s.wall});
  return StructureSystem(std::move(parts));
}

double CoupledSystem::largest_damping(const StructureSystem& system) const
{
  return std::max(assembly.motion.damping, system.damping());
}

void CoupledSystem::move_structures(double h)
{
  for (Member& s : structures) {
    if (!moves(s)) continue;
    s.exchange.sum_forces(wall_of(s));   // f_s = N^T f_wall at x^n
    s.exchange.step_structure(h);        // v_s^{n+1/2}
    s.exchange.move_wall(wall_of(s), h); // v_wall = N v_s, x_wall^{n+1}
  }
}

void CoupledSystem::step_with_particles_held()
{
  if (n_steps % dem::steps_between_step_checks == 0) check_time_step();
  move_structures(dt);
  dem::add_forces(assembly, dt);
  dt_before = dt;
  time += dt;
  ++n_steps;
}

void CoupledSystem::find_time_step()
{
  const StructureSystem system = structure_system();
  dem::find_stable_step(stable_step, assembly, step_spec, dt, largest_damping(system),
                        &system);
  dt = step_spec.safety * stable_step.limit;
  if (!std::isfinite(dt))
    throw InputError(
        "Specimen: no particles touch, none are bonded, and no structure has a "
        "stiffness: there is no stable time step");
  choose_subcycles();
}

void CoupledSystem::check_time_step()
{
  const StructureSystem system = structure_system();
  const std::uint64_t n_before = stable_step.n_evaluations;
  dem::update_stable_step(stable_step, assembly, step_spec, n_steps, dt,
                          largest_damping(system), &system);
  dt = step_spec.safety * stable_step.limit;
  if (stable_step.n_evaluations > n_before) choose_subcycles(); // the step may be longer
}

/// By interface node: not less than the stiffness of the springs to the particles [N/m].
std::vector<double> CoupledSystem::stiffness_at(const Member& s,
                                                const dem::Springs& springs) const
{
  const dem::Wall& wall = assembly.walls[s.wall];
  std::vector<dem::VectorSum> sums(wall.x.size());
  for (const dem::WallSpring& k : springs.walls) {
    if (k.wall != s.wall) continue;
    const dem::Triangle& t = wall.topology.triangles[dem::uz(k.at.triangle)];
    for (int c = 0; c < 3; ++c)
      sums[dem::uz(t[dem::uz(c)])].x.add(std::max(k.k_n, k.k_s) * k.at.weight[c]);
  }
  dem::ExactReduction all;
  all.add(sums);
  all.run(assembly.comm);
  Nodal of_wall, of_structure;
  for (const dem::VectorSum& node : sums) of_wall.push_back(node.value());
  s.exchange.transfer().to_structure(of_wall, of_structure);
  std::vector<double> stiffness;
  for (const dem::Vec3& k : of_structure) stiffness.push_back(k.x());
  return stiffness;
}

void CoupledSystem::choose_subcycles()
{
  if (std::none_of(structures.begin(), structures.end(),
                   [&](const Member& s) { return moves(s); }))
    return;
  // Impulses at less than half of the shortest period: no motion can keep pace with them.
  const double longest = dem::pi / std::sqrt(stable_step.omega2);
  // While it settles all has about the same frequency, and its ratio is looked at in any step.
  const bool is_settled = settling.phase == Settling::Phase::done;
  const std::size_t most = is_settled && !is_equilibrium_waited_for_ ? largest_subcycle : 1;
  const StructureSystem system = structure_system();
  const dem::Springs springs = dem::present_springs(assembly, dt, &system);
  for (Member& s : structures)
    if (moves(s)) s.structure->choose_subcycle(dt, stiffness_at(s, springs), longest, most);
}

void CoupledSystem::wait_for_equilibrium(bool is_waited_for)
{
  const bool was = std::exchange(is_equilibrium_waited_for_, is_waited_for);
  const bool is_subcycled =
      std::any_of(structures.begin(), structures.end(),
                  [](const Member& s) { return s.structure->subcycle().n > 1; });
  // After a restart the structures have what they had: chosen anew, their limit would differ.
  if (is_waited_for ? is_subcycled : was) choose_subcycles();
}

void CoupledSystem::equalise_frequencies()
{
  const StructureSystem system = structure_system();
  const dem::Springs springs = dem::present_springs(assembly, dt, &system);
  const double omega2 = dem::block_bound(assembly, springs).omega2;
  if (omega2 > 0.0) {
    dem::equalise_frequencies(assembly, springs, omega2);
    for (Member& s : structures) {
      if (!moves(s)) continue;
      // Twice the stiffness: particle and node move against each other, as in the block bound.
      std::vector<double> stiffness = stiffness_at(s, springs);
      for (double& k : stiffness) k *= 2.0;
      s.structure->equalise_frequencies(omega2, stiffness);
    }
  }
  find_time_step();
  dt_before = dt;
}

void CoupledSystem::restore_masses()
{
  dem::restore_masses(assembly);
  dem::scale_masses(assembly, mass_scaling);
  for (Member& s : structures) s.structure->restore_masses();
  find_time_step();
  dt_before = dt;
}

std::string CoupledSystem::where() const
{
  return " (step " + std::to_string(n_steps) + ", t = " + dem::shortest(1e3 * time) +
         " ms)";
}

void CoupledSystem::balance_load()
{
  const double spent = assembly.times.total() - assembly.times.exchange;
  const double since = spent - spent_before_;
  spent_before_ = spent;
  const double most = assembly.comm.global_max(since),
               smallest = assembly.comm.global_min(since);
  if (most > imbalance_allowed * smallest) dem::rebalance(assembly, since);
}

double CoupledSystem::unbalanced() const
{
  double ratio = dem::unbalanced_ratio(assembly);
  for (const Member& s : structures)
    if (moves(s)) ratio = std::max(ratio, s.structure->unbalanced_ratio());
  return ratio;
}

InterfaceBalance CoupledSystem::balance()
{
  InterfaceBalance all;
  for (Member& s : structures)
    all = worst(all, interface_balance(s.exchange, wall_of(s), assembly.comm));
  return all;
}

EnergyBalances CoupledSystem::energy_balances() const
{
  EnergyBalances e{dem::energy_balance(assembly, dt), {}};
  for (const Member& s : structures) e.structures += s.structure->energies();
  return e;
}

double CoupledSystem::structure_seconds() const
{
  double sum = 0.0;
  for (const Member& s : structures) sum += s.exchange.structure_seconds;
  return sum;
}

double CoupledSystem::exchange_seconds() const
{
  double sum = 0.0;
  for (const Member& s : structures) sum += s.exchange.exchange_seconds;
  return sum;
}

} // namespace mergel::coupling
