/// The installation of a pile in a rock at rest: it is driven down, and books are kept.
#pragma once

#include "apps/coupled/coupled_system.h"
#include "apps/pile/penetration_rate.h"
#include "apps/pile/pile_output.h"

#include <functional>
#include <string>

namespace mergel::apps {

/// Where bonds between grains broke, seen from the pile as it stood then.
class BreakageCount {
public:
  std::size_t all = 0;
  std::size_t near = 0;  ///< within 2 D_p of the axis
  std::size_t above = 0; ///< more than D_p above the shoulder and outside the shaft

  /// Count the bonds that broke since the last call, and forget them; collective.
  void take(dem::Rock& rock);
};

/// Mean pile forces between two records.
struct MeanForce {
  double cone = 0.0, shaft = 0.0;
  std::size_t n = 0;

  void add(const dem::PileLoad& load);
};

/// The pile with its tip at the surface, at rest.
dem::PileWall make_pile(const PileCase& c);

/// Drives the pile down and keeps the books. Collective, as long as nothing else is said.
class Installation {
public:
  /// All that is given must outlive the object.
  /// @param output null on all ranks but the first
  Installation(const PileCase& c, CoupledRock& coupled, PileOutput* output);

  /// Whether a state is that of a pile under way.
  static bool is_in(const dem::State& state) { return state.has("pile_numbers"); }
  /// Depth of the tip in such a state [m].
  static double travelled_in(const dem::State& state)
  {
    return -state.get_rows<double>("pile0_place", 1, 6)[4];
  }

  /// Put the pile on the rock in equilibrium.
  void begin();

  /// Add the books to a state; those of rock and pile are CoupledRock's.
  void put(dem::State& state) const;
  /// Go on as put() told. @throws InputError when the state is of another run
  void take(const dem::State& state);
  /// The next record, or frame, by a spacing that is not that of the run so far.
  void space_records_anew();
  void space_frames_anew();

  /// Drive the pile to the end of its travel.
  /// @param after_step called between two steps, for checkpoints
  /// @throws Unstable when a step fails or the energy book does not close
  void run(const std::function<void()>& after_step);

  const PileRecord& last() const { return last_; }
  double peak() const { return q_peak_; }                           ///< of q_c [Pa]
  double worst_energy_error() const { return worst_energy_error_; } ///< [-]
  const coupling::InterfaceBalance& worst_interface() const { return worst_interface_; }
  const BreakageCount& breakage() const { return breakage_; }
  std::size_t n_bonds() const { return n_bonds_; }     ///< of all kinds, when driving began
  std::size_t n_between() const { return n_between_; } ///< of these, between grains

private:
  double travelled() const; ///< depth of the tip [m]
  double next_frame() const ///< depth of the tip [m]
  {
    return jack_.travel() * static_cast<double>(n_frames_) / case_.frames;
  }
  void count_bonds();
  void frame();
  void record();
  PileRecord new_record(const CoupledRock::Books& books);
  std::string now() const;

  /// Every number of a run, to be kept and taken; `self` may be const.
  template <class Self>
  static auto numbers_of(Self& self);
  template <class Self>
  static auto counts_of(Self& self);

  const PileCase& case_;
  CoupledRock& coupled_;
  PileOutput* output_;
  Jack jack_;
  CoupledRock::Books start_;
  BreakageCount breakage_;
  MeanForce force_;
  PileRecord last_;
  double time_ = 0.0, q_peak_ = 0.0, worst_energy_error_ = 0.0;
  double next_record_ = 0.0; ///< travel [m]
  std::size_t n_frames_ = 0; ///< thresholds of frames passed, the first included
  coupling::InterfaceBalance worst_interface_;
  std::size_t n_bonds_ = 0, n_between_ = 0;
};

} // namespace mergel::apps
