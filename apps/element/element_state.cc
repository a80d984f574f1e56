#include "apps/element/element_state.h"

#include "dem/io/state/assembly_state.h"
#include "dem/io/state/energy_numbers.h"
#include "dem/io/state/named_rows.h"
#include "dem/io/state/stage_numbers.h"
#include "dem/io/state/step_numbers.h"

namespace mergel::apps {

namespace {

using dem::append_vector;
using dem::axis_names;

template <class Numbers, class Matrix>
void append_matrix(Numbers& to, const std::string& name, const std::string& unit, Matrix& m)
{
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      to.push_back({name + ' ' + axis_names[a] + axis_names[b] + ' ' + unit, &m(a, b)});
}

template <class Numbers, class Servo>
void append_servo(Numbers& to, Servo& servo)
{
  to.push_back({"largest rate of the servo [1/s]", &servo.limit});
  to.push_back({"steps of the servo [-]", &servo.steps});
  append_vector(to, "integral of the servo", "[1/s]", servo.integral);
  append_vector(to, "stiffness of the servo", "[Pa]", servo.stiffness);
}

template <class Self>
dem::NumbersOf<Self> numbers_of(Self& s)
{
  dem::NumbersOf<Self> all{{"time step [s]", &s.dt},
                           {"time step before [s]", &s.dt_before},
                           {"time [s]", &s.time},
                           {"controlled strain since the record [-]", &s.since_record},
                           {"largest progress of the stage [-]", &s.largest_progress},
                           {"largest tension of the stage [Pa]", &s.tension},
                           {"gross work [J]", &s.gross_work},
                           {"work at the record [J]", &s.last_work},
                           {"largest strain rate [1/s]", &s.largest_rate},
                           {"mean diameter of the particles [m]", &s.mean_diameter},
                           {"density of the particles [kg/m3]", &s.density}};
  append_vector(all, "edge before the first stage", "[m]", s.size_0);
  append_vector(all, "sum of stresses since the record", "[Pa]", s.stress_sum);
  append_vector(all, "sum of stresses to hold since the record", "[Pa]", s.held_sum);
  append_vector(all, "stiffness before the first stage", "[Pa]", s.stiffness_0);
  append_servo(all, s.servo);
  dem::append_stage(all, s.active);
  dem::append_energies(all, "start: ", s.start);
  dem::append_stable_step(all, s.stable_step);
  dem::append_alarm(all, s.alarm);
  return all;
}

template <class Self>
dem::CountsOf<Self> counts_of(Self& s)
{
  dem::CountsOf<Self> all{{"stage", &s.stage},
                          {"steps", &s.n_steps},
                          {"steps of the stage", &s.n_in_stage},
                          {"steps held after the approach", &s.n_held},
                          {"steps since the record", &s.n_stress},
                          {"rates limited by the servo", &s.servo.n_limited}};
  dem::append_stage_counts(all, s.active);
  dem::append_stable_step_counts(all, s.stable_step);
  return all;
}

template <class Self>
dem::NumbersOf<Self> numbers_of_record(Self& r)
{
  auto& a = r.averages;
  dem::NumbersOf<Self> all{{"time [s]", &r.time},
                           {"controlled strain [-]", &r.controlled_strain},
                           {"time step [s]", &r.time_step},
                           {"stable step [s]", &r.stable_step},
                           {"energy error [-]", &r.energy_error},
                           {"inertial number [-]", &r.inertial_number},
                           {"unbalanced-force ratio [-]", &r.unbalanced},
                           {"antisymmetric part of the stress [-]", &a.antisymmetric},
                           {"coordination by bonds [-]", &a.bond_coordination},
                           {"coordination by contacts [-]", &a.contact_coordination},
                           {"porosity [-]", &a.porosity},
                           {"void ratio [-]", &a.void_ratio}};
  append_vector(all, "stress", "[Pa]", r.whole.stress);
  append_vector(all, "strain", "[-]", r.whole.strain);
  append_vector(all, "stress of the stage", "[Pa]", r.of_stage.stress);
  append_vector(all, "strain of the stage", "[-]", r.of_stage.strain);
  append_vector(all, "traction", "[Pa]", a.traction);
  append_matrix(all, "mean stress", "[Pa]", a.stress);
  append_matrix(all, "bond fabric", "[-]", a.bond_fabric);
  append_matrix(all, "contact fabric", "[-]", a.contact_fabric);
  dem::append_energies(all, "", r.balance);
  return all;
}

template <class Self>
dem::CountsOf<Self> counts_of_record(Self& r)
{
  return {{"stage", &r.stage},
          {"approaches", &r.is_approach},
          {"broken bonds", &r.broken},
          {"broken in tension", &r.broken_by[0]},
          {"broken in compression", &r.broken_by[1]},
          {"broken in shear", &r.broken_by[2]},
          {"broken in bending", &r.broken_by[3]}};
}

} // namespace

void save(dem::State& state, const dem::ElementState& s)
{
  dem::save(state, s.assembly);
  dem::save_numbers(state, "element_numbers", numbers_of(s));
  dem::save_counts(state, "element_counts", counts_of(s));
}

dem::ElementState load_element(dem::State& state, const ElementCase& c)
{
  dem::ElementState s;
  dem::load_numbers(state, "element_numbers", numbers_of(s));
  dem::load_counts(state, "element_counts", counts_of(s));
  if (s.stage >= c.stages.size())
    dem::State::refuse("element_counts", "names a stage that the case does not have");

  dem::PeriodicCell first; // the size effect takes the cell before the first stage
  first.size = s.size_0;
  s.assembly.material = resolved_materials(c, {{}, first, {}});
  dem::load(state, s.assembly);
  dem::draw_strengths(c.specimen.strengths, s.assembly.particles);
  return s;
}

void save(dem::State& state, const std::vector<dem::ElementRecord>& records)
{
  dem::save_number_rows(state, "record_numbers", records,
                        [](auto& r) { return numbers_of_record(r); });
  dem::save_count_rows(state, "record_counts", records,
                       [](auto& r) { return counts_of_record(r); });
}

std::vector<dem::ElementRecord> load_records(const dem::State& state)
{
  auto records = dem::load_count_rows<dem::ElementRecord>(
      state, "record_counts", [](auto& r) { return counts_of_record(r); });
  if (records.empty()) dem::State::refuse("record_counts", "has no record");
  dem::load_number_rows(state, "record_numbers", records,
                        [](auto& r) { return numbers_of_record(r); });
  return records;
}

void save(dem::State& state, const std::vector<dem::Outcome>& outcomes)
{
  std::vector<std::uint64_t> numbers;
  for (const dem::Outcome o : outcomes) numbers.push_back(static_cast<std::uint64_t>(o));
  state.add_common("element_outcomes", std::move(numbers));
}

std::vector<dem::Outcome> load_outcomes(const dem::State& state, std::size_t n_stages)
{
  std::vector<dem::Outcome> outcomes;
  for (const std::uint64_t n : state.get<std::uint64_t>("element_outcomes")) {
    if (n > static_cast<std::uint64_t>(dem::Outcome::unstable))
      dem::State::refuse("element_outcomes", "holds an unknown outcome");
    outcomes.push_back(static_cast<dem::Outcome>(n));
  }
  if (outcomes.empty() || outcomes.size() > n_stages)
    dem::State::refuse("element_outcomes", "counts stages that the case does not have");
  return outcomes;
}

} // namespace mergel::apps
