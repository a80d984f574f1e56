/// Saving and loading an installation: each number by its name.
#include "apps/pile/installation.h"
#include "dem/io/state/energy_numbers.h"

#include <cmath>

namespace mergel::apps {

namespace {

constexpr const char* closest_break = "pile_closest_break";

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

template <class Self>
dem::CountsOf<Self> counts_of_position(Self& position)
{
  return {{"stages done", &position.n_done}, {"under way", &position.is_under_way}};
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
  all.insert(all.end(),
             {{"sum of head forces since the record [N]", &self.force_.head},
              {"sum of lateral forces since the record [N]", &self.force_.lateral},
              {"record: head force [N]", &r.F_head},
              {"record: lateral head force [N]", &r.F_lateral},
              {"record: displacement of the head [m]", &r.displacement},
              {"record: rotation of the head [rad]", &r.rotation},
              {"overlap of the last line on it [-]", &self.said_overlap_},
              {"overlap since the record [-]", &self.overlaps_.largest},
              {"largest overlap [-]", &self.largest_overlaps_.largest},
              {"record: overlap [-]", &r.overlaps.largest}});
  append(all, "largest ", self.worst_interface_);
  append(all, "record: ", r.interface);
  dem::append_energies(all, "record: ", r.balance);
  dem::append_energies(all, "start: ", self.start_.assembly);
  append_structures(all, "start, structures: ", self.start_.structures);
  append_structures(all, "record, head: ", r.head);
  dem::append_alarm(all, self.energy_alarm_);
  return all;
}

template <class Self>
dem::CountsOf<Self> Installation::counts_of(Self& self)
{
  auto &since = self.overlaps_, &largest = self.largest_overlaps_,
       &recorded = self.last_.overlaps;
  return {{"steps since the record", &self.force_.n},
          {"record: stage", &self.last_.stage},
          {"stages at the bearing capacity", &self.n_at_capacity_},
          {"overlaps beyond the mark since the record", &since.beyond_mark},
          {"overlaps beyond the high mark since the record", &since.beyond_high_mark},
          {"most overlaps beyond the mark", &largest.beyond_mark},
          {"most overlaps beyond the high mark", &largest.beyond_high_mark},
          {"record: overlaps beyond the mark", &recorded.beyond_mark},
          {"record: overlaps beyond the high mark", &recorded.beyond_high_mark},
          {"record: broken bonds", &self.last_.broken},
          {"breakages between particles", &self.breakage_.all},
          {"breakages near the axis", &self.breakage_.near},
          {"breakages above the shoulder", &self.breakage_.above},
          {"breakages at the tip", &self.breakage_.at_tip},
          {"breakages away from the shaft", &self.breakage_.away},
          {"frames due so far", &self.n_frames_},
          {"bonds", &self.n_bonds_},
          {"bonds between particles", &self.n_between_},
          {"pushes", &self.n_pushes_}};
}

void Installation::save(dem::State& state) const
{
  Push push = push_;
  if (position_.is_under_way && stage_run_.stage().kind == PileStage::Kind::penetrate)
    push = {stage_run_.rate().start(), stage_run_.rate().travel(), travelled()};
  dem::save_numbers(state, "push", numbers_of_push(push));
  dem::save_counts(state, "stages", counts_of_position(position_));
  dem::save_numbers(state, "pile_numbers", numbers_of(*this));
  dem::save_counts(state, "pile_counts", counts_of(*this));
  if (std::isfinite(breakage_.to_far_field)) // else no bond has broken
    state.add_common<double>(closest_break, {breakage_.to_far_field});
  dem::save_numbers(state, "stage_numbers", StageRun::numbers_of(stage_run_));
  dem::save_counts(state, "stage_counts", StageRun::counts_of(stage_run_));
}

Push Installation::push_in(const dem::State& state)
{
  Push push;
  dem::load_numbers(state, "push", numbers_of_push(push));
  return push;
}

StagePosition Installation::stages_in(const dem::State& state)
{
  StagePosition position;
  dem::load_counts(state, "stages", counts_of_position(position));
  return position;
}

void Installation::load(const dem::State& state)
{
  dem::load_numbers(state, "pile_numbers", numbers_of(*this));
  dem::load_counts(state, "pile_counts", counts_of(*this));
  if (state.has(closest_break)) // not before a bond broke, nor in earlier versions
    breakage_.to_far_field = state.get_rows<double>(closest_break, 1).front();
  dem::load_numbers(state, "stage_numbers", StageRun::numbers_of(stage_run_));
  dem::load_counts(state, "stage_counts", StageRun::counts_of(stage_run_));
  push_ = push_in(state);
  position_ = stages_in(state);
  if (position_.n_fixed() > case_.stages.size())
    dem::State::refuse("stages", "counts stages that the case does not have");
  if (position_.is_under_way) {
    stage_run_.resume(position_.n_done);
    if (stage_run_.stage().kind == PileStage::Kind::penetrate)
      push_.end = stage_run_.rate().travel(); // the case may have another final depth
  } else if (!case_.has_stages() && push_.is_over() && travelled() < case_.travel())
    position_.n_done = 0; // the pile stands at its old end; another push starts there
}

void Installation::space_records_anew()
{
  const double every = stage_run_.record_every();
  next_record_ = every * (std::floor(stage_run_.position() / every) + 1.0);
}

void Installation::space_frames_anew()
{
  n_frames_ = 1;
  while (next_frame() <= travelled()) ++n_frames_;
}

} // namespace mergel::apps
