/// The installation of a pile in a coupled system at rest: the pile is pushed down at its
/// penetration rate, and records and frames are written.
#pragma once

#include "apps/coupled/system_of_case.h"
#include "apps/pile/penetration_rate.h"
#include "apps/pile/pile_output.h"
#include "dem/io/state/named_numbers.h"

#include <functional>
#include <optional>
#include <string>

namespace mergel::apps {

/// Number of bonds between particles that broke, by their place relative to the pile then.
class BreakageCount {
public:
  std::size_t all = 0;
  std::size_t near = 0;  ///< within 2 D_p of the axis
  std::size_t above = 0; ///< more than D_p above the shoulder and outside the shaft

  /// Count the bonds that broke since the last call, and clear their list; collective.
  void collect(const PileCase& c, dem::Assembly& assembly);
};

/// Mean pile forces between two records.
struct MeanForce {
  double tip = 0.0, shaft = 0.0;
  std::size_t n = 0;

  void add(const dem::RigidWall& pile);
};

/// A push of the pile, from rest to rest: depths of the tip [m].
struct Push {
  double start = 0.0; ///< where it starts
  double end = 0.0;   ///< where it is to end
  double tip = 0.0;   ///< where it is

  bool is_over() const { return tip >= end; }
};

/// The pile with its tip at the surface, at rest.
dem::RigidWall make_pile(const PileCase& c);

/// Pushes the pile down and records forces and energies. Member functions are collective,
/// except those that only return a value.
class Installation {
public:
  /// All arguments must outlive the object.
  /// @param output on the first rank, set before begin() or run(); nothing on the others
  Installation(const PileCase& c, coupling::CoupledSystem& coupled,
               std::optional<PileOutput>& output);

  /// Whether the state was saved after the penetration began.
  static bool is_in(const dem::State& state) { return state.has("push"); }
  /// The push in that state. @throws InputError when it is not there
  static Push push_in(const dem::State& state);

  /// Place the pile with its tip at the surface of the system in equilibrium.
  void begin();

  /// Add the numbers and counts of the penetration to a state. CoupledSystem::save() adds
  /// those of assembly and pile.
  void save(dem::State& state) const;
  /// Continue from the numbers of save(). Where the push is over and the case goes deeper,
  /// another push starts. @throws InputError when the state is of another run
  void load(const dem::State& state);
  /// Set the next record, or frame, after its spacing was changed.
  void space_records_anew();
  void space_frames_anew();

  /// Push the pile down to its final depth, if it is not there.
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
  double travelled() const;                            ///< depth of the tip [m]

private:
  double next_frame() const ///< depth of the tip [m]
  {
    return rate_.travel() * static_cast<double>(n_frames_) / case_.frames;
  }
  void count_bonds();
  void frame();
  /// Returns lines for the user; mostly none.
  std::string record();
  PileRecord new_record(const coupling::EnergyBalances& energy_balances);
  std::string now() const;

  void push_further();

  /// Every number of a run by its name, to save and load it; `self` may be const.
  template <class Self>
  static dem::NumbersOf<Self> numbers_of(Self& self);
  template <class Self>
  static dem::CountsOf<Self> counts_of(Self& self);

  const PileCase& case_;
  coupling::CoupledSystem& coupled_;
  std::optional<PileOutput>& output_;
  PenetrationRate rate_;
  coupling::EnergyBalances start_;
  dem::EnergyAlarm energy_alarm_;
  BreakageCount breakage_;
  MeanForce force_;
  PileRecord last_;
  double time_ = 0.0, q_peak_ = 0.0, worst_energy_error_ = 0.0;
  double next_record_ = 0.0; ///< travel [m]
  std::size_t n_frames_ = 0; ///< frames that were due so far, the first included
  coupling::InterfaceBalance worst_interface_;
  std::size_t n_bonds_ = 0, n_between_ = 0;
  std::size_t n_pushes_ = 1;
};

} // namespace mergel::apps
