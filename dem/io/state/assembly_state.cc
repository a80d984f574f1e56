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

/// Of one rank or of all: as ExactReduction has it, the ones that are summed.
std::vector<ExactWide*> sums_of_ranks(Rock& rock)
{
  std::vector<ExactWide*> sums;
  for (EnergySum* s : {&rock.losses.slip, &rock.losses.plastic, &rock.losses.residue,
                       &rock.work.gravity, &rock.work.damping, &rock.work.lock})
    sums.push_back(&s->raw());
  for (Mirror& m : rock.mirrors) {
    sums.push_back(&m.energy.raw());
    append(sums, m.force);
  }
  return sums;
}

/// What every rank knows in full.
std::vector<ExactWide*> sums_of_all(Rock& rock)
{
  std::vector<ExactWide*> sums{&rock.wall_work.raw(), &rock.pile_work.raw(),
                               &rock.cell_work.raw()};
  append(sums, rock.virial);
  for (PlaneWall& w : rock.planes) append(sums, w.force);
  for (Wall& w : rock.walls)
    for (VectorSum& f : w.f) append(sums, f);
  for (PileWall& w : rock.piles) {
    append(sums, w.load.cone);
    append(sums, w.load.shaft);
  }
  return sums;
}

/// A copy of what the sums of a rock need, and no more.
Rock copy_of_sums(const Rock& rock)
{
  Rock copy;
  copy.losses.slip = rock.losses.slip;
  copy.losses.plastic = rock.losses.plastic;
  copy.losses.residue = rock.losses.residue;
  copy.work = rock.work;
  copy.wall_work = rock.wall_work;
  copy.pile_work = rock.pile_work;
  copy.cell_work = rock.cell_work;
  copy.virial = rock.virial;
  for (const Mirror& m : rock.mirrors) {
    copy.mirrors.emplace_back();
    copy.mirrors.back().energy = m.energy;
    copy.mirrors.back().force = m.force;
  }
  for (const PlaneWall& w : rock.planes) copy.planes.emplace_back().force = w.force;
  for (const Wall& w : rock.walls) copy.walls.emplace_back().f = w.f;
  for (const PileWall& w : rock.piles) copy.piles.emplace_back().load = w.load;
  return copy;
}

} // namespace

void put_sums(State& state, const std::string& name, const std::vector<ExactWide*>& sums)
{
  std::vector<std::uint64_t> raw(words * sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::memcpy(&raw[words * k], sums[k], sizeof(ExactWide));
  state.add_common(name, std::move(raw), words);
}

void take_sums(const State& state, const std::string& name,
               const std::vector<ExactWide*>& sums)
{
  const auto& raw = state.get_rows<std::uint64_t>(name, sums.size(), words);
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::memcpy(sums[k], &raw[words * k], sizeof(ExactWide));
}

void put(State& state, const Rock& rock)
{
  const Particles& p = rock.particles;
  put_grains(state, p);
  put_bonds(state, p, rock.bonds);
  put_contacts(state, p, rock.contacts);
  put_breakages(state, rock.losses);
  std::vector<double> cell;
  for (const Vec3& a : {rock.cell.size, rock.cell.rate}) append(cell, a);
  state.add_common("cell", std::move(cell), 6);
  state.add_common<std::uint64_t>("cell_is_driven", {rock.cell.is_driven ? 1u : 0u});
  put_walls(state, rock);
  state.add_common<std::uint64_t>("bonds_broken_and_yielded",
                                  {rock.comm.global_sum(rock.losses.broken),
                                   rock.comm.global_sum(rock.losses.yielded)});
  std::vector<std::uint64_t> broken_by;
  for (const std::size_t k : rock.losses.broken_by)
    broken_by.push_back(rock.comm.global_sum(k));
  state.add_common("bonds_broken_by_mode", std::move(broken_by));

  Rock copy = copy_of_sums(rock);
  ExactReduction all;
  for (EnergySum* s : {&copy.losses.slip, &copy.losses.plastic, &copy.losses.residue,
                       &copy.work.gravity, &copy.work.damping, &copy.work.lock})
    all.add(*s);
  for (Mirror& m : copy.mirrors) {
    all.add(m.energy);
    all.add(m.force);
  }
  all.run(rock.comm);
  put_sums(state, "sums_over_grains", sums_of_ranks(copy));
  put_sums(state, "sums_on_walls", sums_of_all(copy));
}

void take(State& state, Rock& rock)
{
  check_walls(state, rock);
  rock.comm = Communicator();
  rock.particles = take_grains(state);
  state.forget("grain");
  const std::size_t n = rock.particles.size();
  rock.bonds = take_bonds(state, n);
  state.forget("bond_");
  rock.contacts = take_contacts(state, n);
  state.forget("contact_");
  const auto& cell = state.get_rows<double>("cell", 1, 6);
  rock.cell.size = vec_at(cell, 0);
  rock.cell.rate = vec_at(cell, 3);
  rock.cell.is_driven = state.get_rows<std::uint64_t>("cell_is_driven", 1)[0] != 0;
  take_walls(state, n, rock);
  const auto& counts = state.get_rows<std::uint64_t>("bonds_broken_and_yielded", 2);
  rock.losses.broken = counts[0];
  rock.losses.yielded = counts[1];
  const auto& broken_by =
      state.get_rows<std::uint64_t>("bonds_broken_by_mode", n_break_modes);
  std::copy(broken_by.begin(), broken_by.end(), rock.losses.broken_by.begin());
  rock.losses.breakages = take_breakages(state, n);
  take_sums(state, "sums_over_grains", sums_of_ranks(rock));
  take_sums(state, "sums_on_walls", sums_of_all(rock));
  rock.list.invalidate();
}

} // namespace mergel::dem
