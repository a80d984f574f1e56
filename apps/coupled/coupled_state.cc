/// Saving and loading a coupled system as named arrays.
#include "apps/coupled/coupled_system.h"
#include "dem/assembly/distribute.h"
#include "dem/io/state/assembly_state.h"

#include <utility>

namespace mergel::apps {

namespace {

/// The four nodal fields of the far field's motion, by name.
template <class Motion>
auto fields_of(Motion& m)
{
  return std::array<std::pair<const char*, decltype(&m.u)>, 4>{
      {{"far_field_u", &m.u},
       {"far_field_v", &m.v},
       {"far_field_Ku", &m.Ku},
       {"far_field_f", &m.f_interface}}};
}

/// Time step and energies of the far field.
template <class Motion>
auto numbers_of(Motion& m)
{
  auto& e = m.energy;
  return std::array<decltype(&m.dt), 7>{&m.dt,           &e.kinetic,
                                        &e.strain,       &e.interface_work,
                                        &e.gravity_work, &e.initial_stress_work,
                                        &e.damping};
}

/// Length of a row of a nodal field: x, y, z and a fourth number for alignment.
constexpr std::size_t nodal_columns = 4;

void save(dem::State& state, const fem::NodalMotion& motion)
{
  for (const auto& [name, field] : fields_of(motion))
    state.add_common(name,
                     std::vector<double>(field->data(), field->data() + field->size()),
                     nodal_columns);
  std::vector<double> numbers;
  for (const double* a : numbers_of(motion)) numbers.push_back(*a);
  state.add_common("far_field_numbers", std::move(numbers));
}

fem::NodalMotion load_motion(const dem::State& state, const fem::NodalMotion& of_this_mesh)
{
  fem::NodalMotion motion = of_this_mesh;
  for (const auto& [name, field] : fields_of(motion)) {
    const auto& values = state.get_rows<double>(
        name, static_cast<std::size_t>(field->cols()), nodal_columns);
    std::copy(values.begin(), values.end(), field->data());
  }
  const auto numbers = numbers_of(motion);
  const auto& values = state.get_rows<double>("far_field_numbers", numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) *numbers[k] = values[k];
  return motion;
}

} // namespace

void CoupledSystem::save(dem::State& state) const
{
  dem::save(state, assembly);
  apps::save(state, far_field.motion());
  state.add_common<double>("coupled_numbers", {dt, dt_before, time});
  state.add_common<std::uint64_t>(
      "coupled_counts", {n_steps, static_cast<std::uint64_t>(settling.phase), settling.n});
  std::vector<double> x;
  for (const dem::Vec3& a : x_0) x.insert(x.end(), {a.x(), a.y(), a.z()});
  state.add_common("x_0", std::move(x), 3);
}

CoupledSystem::CoupledSystem(const CoupledCase& c, dem::State& state,
                             std::vector<dem::PileWall> piles, fem::FarField field,
                             coupling::Interface interface, MPI_Comm comm)
    : CoupledSystem(c, std::move(field), std::move(interface))
{
  assembly.piles = std::move(piles);
  dem::load(state, assembly);
  dem::draw_strengths(c.strengths, assembly.particles);
  far_field.restore(load_motion(state, far_field.motion()));
  const auto& numbers = state.get_rows<double>("coupled_numbers", 3);
  dt = numbers[0];
  dt_before = numbers[1];
  time = numbers[2];
  const auto& counts = state.get_rows<std::uint64_t>("coupled_counts", 3);
  n_steps = counts[0];
  if (counts[1] > static_cast<std::uint64_t>(Settling::Phase::done))
    dem::State::refuse("coupled_counts", "has an unknown phase of settling");
  settling = {static_cast<Settling::Phase>(counts[1]), counts[2]};
  const auto& x = state.get<double>("x_0", 3);
  if (!x.empty() && x.size() != 3 * assembly.particles.size())
    dem::State::refuse("x_0", "does not have one row per particle");
  for (std::size_t k = 0; k < x.size(); k += 3) x_0.emplace_back(x[k], x[k + 1], x[k + 2]);

  dem::distribute(assembly, comm);
  dem::rebuild_lists(assembly);
}

} // namespace mergel::apps
