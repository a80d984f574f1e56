#include "dem/io/state/particle_state.h"

#include "dem/io/state/state_rows.h"
#include "dem/pairs/bond_record.h"

#include <algorithm>

namespace mergel::dem {

namespace {

constexpr std::size_t state_columns = 12, load_columns = 6;

} // namespace

void save_particles(State& state, const Particles& p)
{
  std::vector<std::uint32_t> number;
  std::vector<double> states, load;
  std::vector<std::int32_t> n_bonds;
  std::vector<double> mass_factor, applied_force;
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    number.push_back(i);
    for (const Vec3& a : {b.x, b.v, b.omega}) append(states, a);
    states.insert(states.end(), {b.R, b.S, b.m});
    append(load, p.load[i].f);
    append(load, p.load[i].t);
    n_bonds.push_back(p.n_bonds[i]);
    if (!p.mass_factor.empty()) mass_factor.push_back(p.mass_factor[i]);
    if (!p.applied_force.empty()) append(applied_force, p.applied_force[i]);
  });
  state.add("grains", std::move(number));
  state.add("grain_bodies", std::move(states), state_columns);
  state.add("grain_loads", std::move(load), load_columns);
  state.add("grain_bonds", std::move(n_bonds));
  if (!p.mass_factor.empty()) state.add("grain_mass_factors", std::move(mass_factor));
  if (!p.applied_force.empty())
    state.add("grain_applied_forces", std::move(applied_force), 3);
}

Particles load_particles(const State& state)
{
  const auto& number = state.get<std::uint32_t>("grains");
  const std::size_t n = number.size();
  const auto& states = state.get_rows<double>("grain_bodies", n, state_columns);
  const auto& load = state.get_rows<double>("grain_loads", n, load_columns);
  const auto& n_bonds = state.get_rows<std::int32_t>("grain_bonds", n);
  const auto order = ascending("grains", n, [&](std::size_t k) { return number[k]; });
  if (n > 0 && number[order.back()] != n - 1) State::refuse("grains", "is not complete");

  Particles p;
  for (const std::size_t k : order) {
    const double* a = &states[k * state_columns];
    ParticleState b;
    b.x = {a[0], a[1], a[2]};
    b.v = {a[3], a[4], a[5]};
    b.omega = {a[6], a[7], a[8]};
    b.R = a[9];
    b.S = a[10];
    b.m = a[11];
    if (!(b.R > 0.0 && b.S > 0.0 && b.m > 0.0))
      State::refuse("grain_bodies", "has a particle without size or mass");
    const Index i = p.add(b);
    p.load[i].f = vec_at(load, k * load_columns);
    p.load[i].t = vec_at(load, k * load_columns + 3);
    p.n_bonds[i] = n_bonds[k];
  }
  if (state.has("grain_mass_factors")) {
    const auto& factors = state.get_rows<double>("grain_mass_factors", n);
    for (const std::size_t k : order) p.mass_factor.push_back(factors[k]);
    if (!std::all_of(factors.begin(), factors.end(), [](double f) { return f > 0.0; }))
      State::refuse("grain_mass_factors", "has a factor that is not positive");
  }
  if (state.has("grain_applied_forces")) {
    const auto& forces = state.get_rows<double>("grain_applied_forces", n, 3);
    for (const std::size_t k : order) p.applied_force.push_back(vec_at(forces, 3 * k));
  }
  return p;
}

namespace {

/// Pairs as two arrays: particles, and the periodic shifts.
class PairColumns {
public:
  void append(const Pair& q)
  {
    particles_.insert(particles_.end(), {q.i, q.j});
    shifts_.insert(shifts_.end(), q.shift.begin(), q.shift.end());
  }
  void save(State& state, const std::string& name)
  {
    state.add(name + "_pairs", std::move(particles_), 2);
    state.add(name + "_shifts", std::move(shifts_), 3);
  }

private:
  std::vector<std::uint32_t> particles_;
  std::vector<std::int16_t> shifts_;
};

std::vector<Pair> load_pairs(const State& state, const std::string& name, std::size_t n)
{
  const auto& particles = state.get<std::uint32_t>(name + "_pairs", 2);
  const std::size_t n_pairs = particles.size() / 2;
  const auto& shifts = state.get_rows<std::int16_t>(name + "_shifts", n_pairs, 3);
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < n_pairs; ++k) {
    if (particles[2 * k] >= particles[2 * k + 1] || particles[2 * k + 1] >= n)
      State::refuse(name + "_pairs", "names particles that cannot be a pair");
    pairs.push_back({particles[2 * k],
                     particles[2 * k + 1],
                     {shifts[3 * k], shifts[3 * k + 1], shifts[3 * k + 2]}});
  }
  return pairs;
}

constexpr std::size_t bond_columns = std::tuple_size_v<BondHistory>;

} // namespace

void save_bonds(State& state, const Particles& p, const Bonds& bonds)
{
  PairColumns pairs;
  std::vector<double> history;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (!p.owns(bonds.pairs[b].i)) continue;
    pairs.append(bonds.pairs[b]);
    const BondHistory h = history_of(bonds, b);
    history.insert(history.end(), h.begin(), h.end());
  }
  pairs.save(state, "bond");
  state.add("bond_histories", std::move(history), bond_columns);
}

Bonds load_bonds(const State& state, std::size_t n)
{
  const std::vector<Pair> pairs = load_pairs(state, "bond", n);
  const auto& history =
      state.get_rows<double>("bond_histories", pairs.size(), bond_columns);
  Bonds bonds;
  for (const std::size_t from :
       ascending("bond_pairs", pairs.size(), [&](std::size_t k) { return pairs[k]; })) {
    BondHistory h;
    std::copy_n(&history[from * bond_columns], bond_columns, h.begin());
    append(bonds, pairs[from], h);
  }
  return bonds;
}

void save_contacts(State& state, const Particles& p, const Contacts& contacts)
{
  PairColumns pairs;
  std::vector<double> shear;
  for (std::size_t c = 0; c < contacts.pairs.size(); ++c) {
    if (!p.owns(contacts.pairs[c].i) || !is_nonzero(contacts.shear[c].f_s, 0.0)) continue;
    pairs.append(contacts.pairs[c]);
    append(shear, contacts.shear[c].f_s);
  }
  pairs.save(state, "contact");
  state.add("contact_shears", std::move(shear), 3);
}

Contacts load_contacts(const State& state, std::size_t n)
{
  const std::vector<Pair> pairs = load_pairs(state, "contact", n);
  const auto& shear = state.get_rows<double>("contact_shears", pairs.size(), 3);
  Contacts contacts;
  for (const std::size_t from :
       ascending("contact_pairs", pairs.size(), [&](std::size_t k) { return pairs[k]; })) {
    contacts.pairs.push_back(pairs[from]);
    contacts.shear.emplace_back().f_s = vec_at(shear, 3 * from);
  }
  return contacts;
}

void save_breakages(State& state, const PairLosses& losses)
{
  PairColumns pairs;
  std::vector<double> x;
  std::vector<std::int32_t> mode;
  for (const Breakage& b : losses.breakages) {
    pairs.append(b.pair);
    append(x, b.x);
    mode.push_back(static_cast<std::int32_t>(b.mode));
  }
  pairs.save(state, "breakage");
  state.add("breakage_modes", std::move(mode));
  state.add("breakage_places", std::move(x), 3);
}

std::vector<Breakage> load_breakages(const State& state, std::size_t n)
{
  const std::vector<Pair> pairs = load_pairs(state, "breakage", n);
  const auto& x = state.get_rows<double>("breakage_places", pairs.size(), 3);
  const auto& mode = state.get_rows<std::int32_t>("breakage_modes", pairs.size());
  std::vector<Breakage> breakages;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (mode[k] < 0 || mode[k] >= static_cast<std::int32_t>(n_break_modes))
      State::refuse("breakage_modes", "names an unknown breakage mode");
    breakages.push_back({pairs[k], vec_at(x, 3 * k), static_cast<BreakMode>(mode[k])});
  }
  return breakages;
}

} // namespace mergel::dem
