/// Saving and loading an installation: each number by its name.
#include "apps/pile/installation.h"
#include "dem/io/state/energy_numbers.h"

#include <cmath>

namespace mergel::apps {

namespace {

template <class Numbers, class Balance>
void append(Numbers& to, const std::string& of, Balance& b)
{
  to.insert(to.end(), {{of + "interface force error [-]", &b.force},
                       {of + "interface moment error [-]", &b.moment},
                       {of + "interface power error [-]", &b.power}});
}

template <class Numbers, class Energies>
void append_structures(Numbers& to, const std::string& of, Energies& e)
{
  to.insert(to.end(), {{of + "kinetic [J]", &e.kinetic},
                       {of + "strain [J]", &e.strain},
                       {of + "work of the particles [J]", &e.wall_work},
                       {of + "work of gravity [J]", &e.gravity_work},
                       {of + "applied work [J]", &e.applied_work},
                       {of + "damping [J]", &e.damping}});
}

template <class Self>
dem::NumbersOf<Self> numbers_of_push(Self& push)
{
  return {{"tip depth at the start [m]", &push.start},
          {"tip depth at the end [m]", &push.end},
          {"tip depth [m]", &push.tip}};
}

} // namespace

template <class Self>
dem::NumbersOf<Self> Installation::numbers_of(Self& self)
{
  auto& r = self.last_;
  dem::NumbersOf<Self> all{{"time [s]", &self.time_},
                           {"largest q_c [Pa]", &self.q_peak_},
                           {"largest energy error [-]", &self.worst_energy_error_},
                           {"tip depth at the next record [m]", &self.next_record_},
                           {"sum of tip forces since the record [N]", &self.force_.tip},
                           {"sum of shaft forces since the record [N]", &self.force_.shaft},
                           {"record: time [s]", &r.time},
                           {"record: depth [m]", &r.depth},
                           {"record: tip depth [m]", &r.tip_depth},
                           {"record: tip force [N]", &r.F_tip},
                           {"record: shaft force [N]", &r.F_shaft},
                           {"record: q_c [Pa]", &r.q_c},
                           {"record: unbalanced-force ratio [-]", &r.unbalanced},
                           {"record: kinetic energy [J]", &r.kinetic},
                           {"record: energy error [-]", &r.energy_error},
                           {"record: time step [s]", &r.time_step},
                           {"record: stable step [s]", &r.stable_step}};
  append(all, "largest ", self.worst_interface_);
  append(all, "record: ", r.interface);
  dem::append_energies(all, "record: ", r.balance);
  dem::append_energies(all, "start: ", self.start_.assembly);
  append_structures(all, "start, structures: ", self.start_.structures);
  dem::append_alarm(all, self.energy_alarm_);
  return all;
}

template <class Self>
dem::CountsOf<Self> Installation::counts_of(Self& self)
{
  return {{"steps since the record", &self.force_.n},
          {"record: broken bonds", &self.last_.broken},
          {"breakages between particles", &self.breakage_.all},
          {"breakages near the axis", &self.breakage_.near},
          {"breakages above the shoulder", &self.breakage_.above},
          {"frames due so far", &self.n_frames_},
          {"bonds", &self.n_bonds_},
          {"bonds between particles", &self.n_between_},
          {"pushes", &self.n_pushes_}};
}

void Installation::save(dem::State& state) const
{
  const Push push{rate_.start(), rate_.travel(), travelled()};
  dem::save_numbers(state, "push", numbers_of_push(push));
  dem::save_numbers(state, "pile_numbers", numbers_of(*this));
  dem::save_counts(state, "pile_counts", counts_of(*this));
}

Push Installation::push_in(const dem::State& state)
{
  Push push;
  dem::load_numbers(state, "push", numbers_of_push(push));
  return push;
}

void Installation::load(const dem::State& state)
{
  dem::load_numbers(state, "pile_numbers", numbers_of(*this));
  dem::load_counts(state, "pile_counts", counts_of(*this));
  const Push push = push_in(state);
  rate_ = PenetrationRate(case_, push.start);
  if (push.is_over() && travelled() < rate_.travel()) push_further();
}

/// The pile stands at its old end; what it does from there does not depend on that end.
void Installation::push_further()
{
  rate_ = PenetrationRate(case_, travelled());
  ++n_pushes_;
  space_records_anew();
  space_frames_anew();
}

void Installation::space_records_anew()
{
  next_record_ = case_.record_every * (std::floor(travelled() / case_.record_every) + 1.0);
}

void Installation::space_frames_anew()
{
  n_frames_ = 1;
  while (n_frames_ < static_cast<std::size_t>(case_.frames) && next_frame() <= travelled())
    ++n_frames_;
}

} // namespace mergel::apps
