#include "dem/io/state/assembly_state.h"

#include "dem/io/state/particle_state.h"
#include "dem/io/state/state_rows.h"
#include "dem/io/state/wall_state.h"

#include <algorithm>
#include <cstring>

namespace mergel::dem {

namespace {

constexpr std::size_t words = sizeof(ExactWide) / sizeof(std::uint64_t);

template <class Sum>
void append(std::vector<ExactWide*>& to, ExactVector<Sum>& v)
{
  to.insert(to.end(), {&v.x.raw(), &v.y.raw(), &v.z.raw()});
}

/// The sums of which each rank holds a part; ExactReduction adds them up.
std::vector<ExactWide*> sums_of_ranks(Assembly& assembly)
{
  std::vector<ExactWide*> sums;
  for (EnergySum* s :
       {&assembly.losses.slip, &assembly.losses.plastic, &assembly.losses.breakage_release,
        &assembly.work.gravity, &assembly.work.damping, &assembly.work.rotation_constraint})
    sums.push_back(&s->raw());
  for (Mirror& m : assembly.mirrors) {
    sums.push_back(&m.energy.raw());
    append(sums, m.force);
  }
  return sums;
}

/// The sums of which every rank holds the total.
std::vector<ExactWide*> sums_of_all(Assembly& assembly)
{
  std::vector<ExactWide*> sums{&assembly.wall_work.raw(), &assembly.pile_work.raw(),
                               &assembly.cell_work.raw()};
  append(sums, assembly.virial);
  for (PlaneWall& w : assembly.planes) append(sums, w.force);
  for (Wall& w : assembly.walls)
    for (VectorSum& f : w.f) append(sums, f);
  for (PileWall& w : assembly.piles) {
    append(sums, w.load.cone);
    append(sums, w.load.shaft);
  }
  return sums;
}

/// A copy of the sums of an assembly only.
Assembly copy_of_sums(const Assembly& assembly)
{
  Assembly copy;
  copy.losses.slip = assembly.losses.slip;
  copy.losses.plastic = assembly.losses.plastic;
  copy.losses.breakage_release = assembly.losses.breakage_release;
  copy.work = assembly.work;
  copy.wall_work = assembly.wall_work;
  copy.pile_work = assembly.pile_work;
  copy.cell_work = assembly.cell_work;
  copy.virial = assembly.virial;
  for (const Mirror& m : assembly.mirrors) {
    copy.mirrors.emplace_back();
    copy.mirrors.back().energy = m.energy;
    copy.mirrors.back().force = m.force;
  }
  for (const PlaneWall& w : assembly.planes) copy.planes.emplace_back().force = w.force;
  for (const Wall& w : assembly.walls) copy.walls.emplace_back().f = w.f;
  for (const PileWall& w : assembly.piles) copy.piles.emplace_back().load = w.load;
  return copy;
}

} // namespace

void save_sums(State& state, const std::string& name, const std::vector<ExactWide*>& sums)
{
  std::vector<std::uint64_t> raw(words * sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::memcpy(&raw[words * k], sums[k], sizeof(ExactWide));
  state.add_common(name, std::move(raw), words);
}

void load_sums(const State& state, const std::string& name,
               const std::vector<ExactWide*>& sums)
{
  const auto& raw = state.get_rows<std::uint64_t>(name, sums.size(), words);
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::memcpy(sums[k], &raw[words * k], sizeof(ExactWide));
}

void save(State& state, const Assembly& assembly)
{
  const Particles& p = assembly.particles;
  save_particles(state, p);
  save_bonds(state, p, assembly.bonds);
  save_contacts(state, p, assembly.contacts);
  save_breakages(state, assembly.losses);
  std::vector<double> cell;
  for (const Vec3& a : {assembly.cell.size, assembly.cell.rate}) append(cell, a);
  state.add_common("cell", std::move(cell), 6);
  state.add_common<std::uint64_t>("cell_is_driven",
                                  {assembly.cell.is_strain_controlled ? 1u : 0u});
  save_walls(state, assembly);
  state.add_common<std::uint64_t>("bonds_broken_and_yielded",
                                  {assembly.comm.global_sum(assembly.losses.broken),
                                   assembly.comm.global_sum(assembly.losses.yielded)});
  std::vector<std::uint64_t> broken_by;
  for (const std::size_t k : assembly.losses.broken_by)
    broken_by.push_back(assembly.comm.global_sum(k));
  state.add_common("bonds_broken_by_mode", std::move(broken_by));

  Assembly copy = copy_of_sums(assembly);
  ExactReduction all;
  for (EnergySum* s :
       {&copy.losses.slip, &copy.losses.plastic, &copy.losses.breakage_release,
        &copy.work.gravity, &copy.work.damping, &copy.work.rotation_constraint})
    all.add(*s);
  for (Mirror& m : copy.mirrors) {
    all.add(m.energy);
    all.add(m.force);
  }
  all.run(assembly.comm);
  save_sums(state, "sums_over_grains", sums_of_ranks(copy));
  save_sums(state, "sums_on_walls", sums_of_all(copy));
}

void load(State& state, Assembly& assembly)
{
  check_walls(state, assembly);
  assembly.comm = Communicator();
  assembly.particles = load_particles(state);
  state.forget("grain");
  const std::size_t n = assembly.particles.size();
  assembly.bonds = load_bonds(state, n);
  state.forget("bond_");
  assembly.contacts = load_contacts(state, n);
  state.forget("contact_");
  const auto& cell = state.get_rows<double>("cell", 1, 6);
  assembly.cell.size = vec_at(cell, 0);
  assembly.cell.rate = vec_at(cell, 3);
  assembly.cell.is_strain_controlled =
      state.get_rows<std::uint64_t>("cell_is_driven", 1)[0] != 0;
  load_walls(state, n, assembly);
  const auto& counts = state.get_rows<std::uint64_t>("bonds_broken_and_yielded", 2);
  assembly.losses.broken = counts[0];
  assembly.losses.yielded = counts[1];
  const auto& broken_by =
      state.get_rows<std::uint64_t>("bonds_broken_by_mode", n_break_modes);
  std::copy(broken_by.begin(), broken_by.end(), assembly.losses.broken_by.begin());
  assembly.losses.breakages = load_breakages(state, n);
  load_sums(state, "sums_over_grains", sums_of_ranks(assembly));
  load_sums(state, "sums_on_walls", sums_of_all(assembly));
  assembly.list.invalidate();
}

} // namespace mergel::dem
