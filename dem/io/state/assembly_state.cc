#include "dem/io/state/assembly_state.h"

#include "dem/io/state/particle_state.h"
#include "dem/io/state/state_rows.h"
#include "dem/io/state/wall_state.h"

#include <algorithm>
#include <cstring>
#include <map>

namespace mergel::dem {

namespace {

constexpr std::size_t words = sizeof(ExactWide) / sizeof(std::uint64_t);

/// Exact sums as integers in words of 64 bits, the lowest first, each under its name; each
/// is the total over all ranks. Collective.
void save_sums(State& state, const Assembly& assembly)
{
  std::map<std::string, std::vector<ExactWide>> all;
  ExactReduction partial;
  visit_sums(assembly, [&](const char* name, SumKind kind, const auto& sum) {
    std::vector<ExactWide>& raw = all["sum_" + std::string(name)];
    const bool is_in_parts = kind == SumKind::by_rank || kind == SumKind::by_node;
    visit_part(sum, [&](const ExactWide& a) { raw.push_back(a); });
    if (is_in_parts)
      for (ExactWide& a : raw) partial.add(a);
  });
  partial.run(assembly.comm);
  for (const auto& [name, raw] : all) {
    std::vector<std::uint64_t> rows(words * raw.size());
    std::memcpy(rows.data(), raw.data(), raw.size() * sizeof(ExactWide));
    state.add_common(name, std::move(rows), words);
  }
}

void load_sums(const State& state, Assembly& assembly)
{
  visit_sums(assembly, [&](const char* name, SumKind, auto& sum) {
    std::size_t n = 0;
    visit_raw(sum, [&](ExactWide&) { ++n; });
    const auto& rows = state.get_rows<std::uint64_t>("sum_" + std::string(name), n, words);
    const std::uint64_t* from = rows.data();
    visit_raw(sum, [&](ExactWide& a) {
      std::memcpy(&a, from, sizeof a);
      from += words;
    });
  });
}

} // namespace

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

  save_sums(state, assembly);
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
  load_sums(state, assembly);
  assembly.list.invalidate();
}

} // namespace mergel::dem
