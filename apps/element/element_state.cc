/// Saving and loading an element test and its records as named arrays.
#include "apps/element/element_state.h"

#include "dem/io/state/assembly_state.h"

#include <algorithm>
#include <type_traits>

namespace mergel::apps {

namespace {

/// Pointers to the numbers of a struct, in a fixed order; `Self` may be const.
template <class T, class Self>
using NumbersOf = std::vector<std::conditional_t<std::is_const_v<Self>, const T, T>*>;

template <class Numbers, class Matrix>
void append(Numbers& all, Matrix& m)
{
  for (Eigen::Index k = 0; k < m.size(); ++k) all.push_back(m.data() + k);
}

template <class Numbers, class Balance>
void append_balance(Numbers& all, Balance& e)
{
  all.insert(all.end(),
             {&e.kinetic, &e.bonds, &e.contacts, &e.walls, &e.mirror, &e.gravity,
              &e.wall_work, &e.rigid_wall_work, &e.cell_work, &e.slip, &e.plastic,
              &e.breakage_release, &e.rotation_constraint, &e.damping});
}

template <class Self>
NumbersOf<double, Self> numbers_of(Self& s)
{
  auto& c = s.active;
  NumbersOf<double, Self> all{&s.dt,
                              &s.dt_before,
                              &s.time,
                              &s.since_record,
                              &s.largest_progress,
                              &s.tension,
                              &s.gross_work,
                              &s.last_work,
                              &s.largest_rate,
                              &s.servo.limit,
                              &s.servo.steps,
                              &c.at_zero,
                              &c.slope,
                              &c.direction,
                              &c.target,
                              &c.controlled_stress_at_start,
                              &c.strain_at_start,
                              &c.value_at_start,
                              &c.strain_to_return,
                              &c.remaining};
  for (auto& rule : c.rules) all.push_back(&rule.stress);
  for (auto* v : {&s.size_0, &s.stress_sum, &s.held_sum, &s.stiffness_0, &s.servo.integral,
                  &s.servo.stiffness, &c.size_0, &c.offset})
    for (int a = 0; a < 3; ++a) all.push_back(&(*v)[a]);
  append_balance(all, s.start);
  return all;
}

template <class Self>
NumbersOf<std::size_t, Self> counts_of(Self& s)
{
  return {&s.stage, &s.n_steps, &s.n_in_stage, &s.n_held, &s.n_stress, &s.servo.n_limited};
}

/// Choices of a stage: numbers of enumerators, 0 or 1 for flags.
std::vector<std::uint64_t> choices_of(const dem::ActiveStage& c)
{
  std::vector<std::uint64_t> all{
      static_cast<std::uint64_t>(c.controlled), static_cast<std::uint64_t>(c.follow),
      static_cast<std::uint64_t>(c.quantity), c.returns, c.is_approaching};
  for (const dem::AxisRule& rule : c.rules)
    all.push_back(static_cast<std::uint64_t>(rule.kind));
  return all;
}

template <class Choice>
Choice choice_at(const std::vector<std::uint64_t>& all, std::size_t k, Choice last)
{
  if (all[k] > static_cast<std::uint64_t>(last))
    dem::State::refuse("element_choices", "holds an unknown choice");
  return static_cast<Choice>(all[k]);
}

void load_choices(const std::vector<std::uint64_t>& all, dem::ActiveStage& c)
{
  c.controlled = choice_at(all, 0, dem::ActiveStage::Controlled::y);
  c.follow = choice_at(all, 1, dem::ActiveStage::Follow::each);
  c.quantity = choice_at(all, 2, dem::Quantity::controlled_stress);
  c.returns = choice_at(all, 3, true);
  c.is_approaching = choice_at(all, 4, true);
  for (std::size_t a = 0; a < 3; ++a)
    c.rules[a].kind = choice_at(all, 5 + a, dem::AxisRule::Kind::stress_controlled);
}

template <class Self>
NumbersOf<double, Self> record_numbers_of(Self& r)
{
  auto& a = r.averages;
  NumbersOf<double, Self> all{
      &r.time,       &r.controlled_strain, &r.energy_error,      &r.inertial_number,
      &r.unbalanced, &a.antisymmetric,     &a.bond_coordination, &a.contact_coordination,
      &a.porosity,   &a.void_ratio};
  for (auto* state : {&r.whole, &r.of_stage})
    for (auto* v : {&state->stress, &state->strain})
      for (int k = 0; k < 3; ++k) all.push_back(&(*v)[k]);
  for (int k = 0; k < 3; ++k) all.push_back(&a.traction[k]);
  append(all, a.stress);
  append(all, a.bond_fabric);
  append(all, a.contact_fabric);
  append_balance(all, r.balance);
  return all;
}

std::size_t n_record_numbers()
{
  const dem::ElementRecord any;
  return record_numbers_of(any).size();
}

constexpr std::size_t record_counts = 3 + dem::n_break_modes;

template <class Number>
std::vector<std::remove_const_t<Number>> values_at(const std::vector<Number*>& all)
{
  std::vector<std::remove_const_t<Number>> values;
  for (const Number* a : all) values.push_back(*a);
  return values;
}

template <class Number, class Value>
void load_values(const std::vector<Number*>& all, const Value* from)
{
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = from[k];
}

} // namespace

void save(dem::State& state, const dem::ElementState& s)
{
  dem::save(state, s.assembly);
  state.add_common("element_numbers", values_at(numbers_of(s)));
  const std::vector<std::size_t> counts = values_at(counts_of(s));
  state.add_common("element_counts",
                   std::vector<std::uint64_t>(counts.begin(), counts.end()));
  state.add_common("element_choices", choices_of(s.active));
  state.add_common<double>("element_grains", {s.mean_diameter, s.density});
}

dem::ElementState load_element(dem::State& state, const ElementCase& c)
{
  dem::ElementState s;
  const auto numbers = numbers_of(s);
  load_values(numbers, state.get_rows<double>("element_numbers", numbers.size()).data());
  const auto counts = counts_of(s);
  load_values(counts,
              state.get_rows<std::uint64_t>("element_counts", counts.size()).data());
  if (s.stage >= c.stages.size())
    dem::State::refuse("element_counts", "names a stage that the case does not have");
  load_choices(state.get_rows<std::uint64_t>("element_choices", 8), s.active);
  const auto& particles = state.get_rows<double>("element_grains", 2);
  s.mean_diameter = particles[0];
  s.density = particles[1];

  dem::PeriodicCell first; // the size effect takes the cell before the first stage
  first.size = s.size_0;
  s.assembly.material = resolved_materials(c, {{}, first, {}});
  dem::load(state, s.assembly);
  dem::draw_strengths(c.specimen.strengths, s.assembly.particles);
  return s;
}

void save(dem::State& state, const std::vector<dem::ElementRecord>& records)
{
  std::vector<double> numbers;
  std::vector<std::uint64_t> counts;
  for (const dem::ElementRecord& r : records) {
    for (const double* a : record_numbers_of(r)) numbers.push_back(*a);
    counts.insert(counts.end(), {r.stage, r.is_approach, r.broken});
    counts.insert(counts.end(), r.broken_by.begin(), r.broken_by.end());
  }
  state.add_common("record_numbers", std::move(numbers), n_record_numbers());
  state.add_common("record_counts", std::move(counts), record_counts);
}

std::vector<dem::ElementRecord> load_records(const dem::State& state)
{
  const std::size_t n_numbers = n_record_numbers();
  const auto& counts = state.get<std::uint64_t>("record_counts", record_counts);
  std::vector<dem::ElementRecord> records(counts.size() / record_counts);
  const auto& numbers = state.get_rows<double>("record_numbers", records.size(), n_numbers);
  for (std::size_t k = 0; k < records.size(); ++k) {
    dem::ElementRecord& r = records[k];
    load_values(record_numbers_of(r), &numbers[k * n_numbers]);
    const std::uint64_t* n = &counts[k * record_counts];
    r.stage = n[0];
    r.is_approach = n[1] != 0;
    r.broken = n[2];
    std::copy_n(n + 3, dem::n_break_modes, r.broken_by.begin());
  }
  return records;
}

} // namespace mergel::apps
