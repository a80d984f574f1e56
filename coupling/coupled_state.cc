/// Saving and loading a coupled system as named arrays.
#include "coupling/coupled_system.h"
#include "dem/assembly/distribute.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/named_numbers.h"
#include "dem/io/state/state_rows.h"
#include "dem/io/state/step_numbers.h"

namespace mergel::coupling {

namespace {

template <class System>
dem::NumbersOf<System> numbers_of(System& s)
{
  dem::NumbersOf<System> all{{"time step [s]", &s.dt},
                             {"previous time step [s]", &s.dt_before},
                             {"time [s]", &s.time}};
  dem::append_stable_step(all, s.stable_step);
  return all;
}

template <class System>
dem::CountsOf<System> counts_of(System& s)
{
  dem::CountsOf<System> all{{"steps [-]", &s.n_steps},
                            {"phase of settling", &s.settling.phase, Settling::Phase::done},
                            {"steps in this phase [-]", &s.settling.n}};
  dem::append_stable_step_counts(all, s.stable_step);
  return all;
}

} // namespace

void CoupledSystem::save(dem::State& state) const
{
  dem::save(state, assembly);
  for (const Member& s : structures) s.structure->save(state, s.name);
  dem::save_numbers(state, "coupled_numbers", numbers_of(*this));
  dem::save_counts(state, "coupled_counts", counts_of(*this));
  std::vector<double> x;
  for (const dem::Vec3& a : x_0) dem::append(x, a);
  state.add_common("x_0", std::move(x), 3);
}

CoupledSystem::CoupledSystem(const CoupledSpec& spec, std::vector<StructureSpec> specs,
                             dem::State& state, std::vector<dem::RigidWall> rigid_walls,
                             MPI_Comm comm)
    : CoupledSystem(spec, specs)
{
  assembly.rigid_walls = std::move(rigid_walls);
  dem::load(state, assembly);
  dem::draw_strengths(spec.strengths, assembly.particles);
  for (Member& s : structures) s.structure->load(state, s.name);
  dem::load_numbers(state, "coupled_numbers", numbers_of(*this));
  dem::load_counts(state, "coupled_counts", counts_of(*this));
  const auto& x = state.get<double>("x_0", 3);
  if (!x.empty() && x.size() != 3 * assembly.particles.size())
    dem::State::refuse("x_0", "does not have one row per particle");
  for (std::size_t k = 0; k < x.size(); k += 3) x_0.push_back(dem::vec_at(x, k));

  dem::distribute(assembly, comm);
  dem::rebuild_lists(assembly);
  const double dt_then = dt;
  dt = step_spec.safety * stable_step.limit; // the restart may have another safety
  if (dt != dt_then) choose_subcycles();
}

} // namespace mergel::coupling
