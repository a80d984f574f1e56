/// The installation of a pile in a coupled system at rest: the pile goes through its loading
/// stages, and records and frames are written.
#pragma once

#include "apps/coupled/system_of_case.h"
#include "apps/pile/pile_output.h"
#include "apps/pile/stage_run.h"
#include "dem/assembly/overlaps.h"
#include "dem/io/state/named_numbers.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace mergel::apps {

/// Number of bonds between particles that broke, by their place relative to the pile then.
class BreakageCount {
public:
  std::size_t all = 0;
  std::size_t near = 0;   ///< within 2 D_p of the axis
  std::size_t above = 0;  ///< more than D_p above the shoulder and outside the shaft
  std::size_t at_tip = 0; ///< below the shoulder and within 2 D_p of the tip
  /// More than D_p/2 above the shoulder, D_p/2 from the shaft and D_p below the surface.
  std::size_t away = 0;
  /// Of the break that was closest to the far field, from its side or its floor as meshed [m];
  /// infinite before a bond has broken.
  double to_far_field = std::numeric_limits<double>::infinity();

  /// Count the bonds that broke since the last call, and clear their list; collective.
  void collect(const PileCase& c, dem::Assembly& assembly);
};

/// Mean pile forces between two records.
struct MeanForce {
  double tip = 0.0, shaft = 0.0;
  double head = 0.0, lateral = 0.0; ///< of the head: downwards, along x
  std::size_t n = 0;

  void add(const dem::RigidWall& pile, const coupling::DrivenPile& head_of_pile);
};

/// Where a saved installation is.
struct StagePosition {
  std::uint64_t n_done = 0;  ///< stages
  bool is_under_way = false; ///< the next one has begun
  std::uint64_t n_fixed() const { return n_done + (is_under_way ? 1 : 0); }
};

/// A penetration, from rest to rest: depths of the tip [m].
struct Push {
  double start = 0.0; ///< where it starts
  double end = 0.0;   ///< where it is to end
  double tip = 0.0;   ///< where it is

  bool is_over() const { return tip >= end; }
};

/// The pile with its tip at the surface, at rest.
dem::RigidWall make_pile(const PileCase& c);

/// Leads the pile through its stages and records forces and energies. Member functions are
/// collective, except those that only return a value.
class Installation {
public:
  /// All arguments must outlive the object.
  /// @param output on the first rank, set before begin() or run(); nothing on the others
  Installation(const PileCase& c, coupling::CoupledSystem& coupled,
               std::optional<PileOutput>& output);

  /// Whether the state was saved after the penetration began.
  static bool is_in(const dem::State& state) { return state.has("push"); }
  /// The last penetration in that state, and where it is in its stages.
  /// @throws InputError when they are not there
  static Push push_in(const dem::State& state);
  static StagePosition stages_in(const dem::State& state);

  /// Place the pile with its tip at the surface of the system in equilibrium.
  void begin();

  /// Add the numbers and counts of the penetration to a state. CoupledSystem::save() adds
  /// those of assembly and pile.
  void save(dem::State& state) const;
  /// Continue from the numbers of save(). Where a final depth was reached and the case goes
  /// deeper, another push starts. @throws InputError when the state is of another run
  void load(const dem::State& state);
  /// Set the next record, or frame, after its spacing was changed.
  void space_records_anew();
  void space_frames_anew();

  /// Go through the stages that are not done.
  /// @param after_step called between two steps, for checkpoints
  /// @throws Unstable when a step fails or the energy error exceeds 0.01
  void run(const std::function<void()>& after_step);

  const PileRecord& last() const { return last_; }
  double peak() const { return q_peak_; }                           ///< of q_c [Pa]
  double worst_energy_error() const { return worst_energy_error_; } ///< [-]
  const dem::EnergyAlarm& energy_alarm() const { return energy_alarm_; }
  const coupling::InterfaceBalance& worst_interface() const { return worst_interface_; }
  const BreakageCount& breakage() const { return breakage_; }
  std::size_t n_bonds() const { return n_bonds_; }     ///< of all kinds, at the start
  std::size_t n_between() const { return n_between_; } ///< of these, between particles
  std::size_t n_pushes() const { return n_pushes_; }   ///< the present one included
  const dem::Overlaps& largest_overlaps() const { return largest_overlaps_; }
  double travelled() const { return stage_run_.tip_depth(); } ///< depth of the tip [m]
  const coupling::DrivenPile& head() const { return stage_run_.head(); }
  const StagePosition& position() const { return position_; }
  /// "penetration", "stage 2 (hold)".
  std::string phase() const;
  std::size_t n_at_capacity() const { return n_at_capacity_; } ///< stages that ended there

private:
  double next_frame() const ///< depth of the tip [m]
  {
    return case_.travel() * static_cast<double>(n_frames_) / case_.frames;
  }
  void begin_stage();
  void run_stage(const std::function<void()>& after_step);
  void end_stage();
  /// Returns a line for the user where they grow; mostly none.
  std::string read_overlaps();
  void count_bonds();
  void frame();
  /// Returns lines for the user; mostly none.
  std::string record();
  PileRecord new_record(const coupling::EnergyBalances& energy_balances);
  std::string now() const;

  /// Every number of a run by its name, to save and load it; `self` may be const.
  template <class Self>
  static dem::NumbersOf<Self> numbers_of(Self& self);
  template <class Self>
  static dem::CountsOf<Self> counts_of(Self& self);

  const PileCase& case_;
  coupling::CoupledSystem& coupled_;
  std::optional<PileOutput>& output_;
  StageRun stage_run_;
  StagePosition position_;
  Push push_;
  ShaftRings rings_;
  coupling::EnergyBalances start_;
  dem::EnergyAlarm energy_alarm_;
  BreakageCount breakage_;
  MeanForce force_;
  PileRecord last_;
  double time_ = 0.0, q_peak_ = 0.0, worst_energy_error_ = 0.0;
  double next_record_ = 0.0; ///< in the measure of the stage: StageRun::position()
  std::size_t n_frames_ = 0; ///< frames that were due so far, the first included
  coupling::InterfaceBalance worst_interface_;
  std::size_t n_bonds_ = 0, n_between_ = 0;
  std::size_t n_pushes_ = 0, n_at_capacity_ = 0;
  dem::Overlaps overlaps_, largest_overlaps_; ///< since the last record, since the start
  double said_overlap_ = 0.0;                 ///< at which the last line on it was said [-]
};

} // namespace mergel::apps
