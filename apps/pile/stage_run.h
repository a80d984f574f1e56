/// One loading stage of a pile under way: what its head does, and when it ends.
#pragma once

#include "apps/pile/penetration_rate.h"
#include "coupling/coupled_system.h"
#include "coupling/driven_pile.h"

#include <string>

namespace mergel::apps {

/// Member functions are collective, except those that only return a value.
class StageRun {
public:
  /// All arguments must outlive the object.
  StageRun(const PileCase& c, coupling::CoupledSystem& coupled)
      : case_(c), coupled_(coupled)
  {
    head_ = coupling::DrivenPile(c.inertia());
  }

  /// Begin this stage of the case at the present state.
  /// @throws CollectiveFailure when the head force does not allow it
  void begin(std::size_t stage);
  /// After the numbers were loaded: the stage is the one of the case.
  void resume(std::size_t stage);
  /// One coupled step.
  void step();
  /// Whether the stage has ended, after a step.
  /// @throws Unstable when it finds no equilibrium, or the pile is too light for the step
  bool is_over();

  const PileStage& stage() const { return case_.stages[stage_]; }
  const coupling::DrivenPile& head() const { return head_; }
  double tip_depth() const { return -pile().x.z(); } ///< [m]
  const PenetrationRate& rate() const { return rate_; }
  /// How far the stage is, in its own measure: depth of the tip [m], displacement [m] or
  /// time [s].
  double position() const;
  /// Of that measure between two records.
  double record_every() const;
  double
  fraction() const; ///< of the stage, 0 to 1; a guess where an equilibrium ends it [-]
  /// What the stage has reached, for the log.
  std::string outcome() const;
  bool has_capacity() const { return has_capacity_; } ///< ended at the largest settlement

  template <class Self>
  static dem::NumbersOf<Self> numbers_of(Self& self)
  {
    dem::NumbersOf<Self> all{{"stage: time [s]", &self.time_},
                             {"stage: tip depth at its start [m]", &self.tip_},
                             {"stage: head force at its start [N]", &self.force_},
                             {"stage: displacement at its start [m]", &self.x_},
                             {"largest head force [N]", &self.largest_force_}};
    const auto of_head = coupling::DrivenPile::numbers_of(self.head_);
    all.insert(all.end(), of_head.begin(), of_head.end());
    return all;
  }
  template <class Self>
  static dem::CountsOf<Self> counts_of(Self& self)
  {
    dem::CountsOf<Self> all{{"stage: steps", &self.n_steps_},
                            {"stage: at the largest settlement", &self.has_capacity_}};
    const auto of_head = coupling::DrivenPile::counts_of(self.head_);
    all.insert(all.end(), of_head.begin(), of_head.end());
    return all;
  }

private:
  const dem::RigidWall& pile() const { return coupled_.assembly.rigid_walls.front(); }
  void choose_rate();
  coupling::HeadTarget target() const;
  void catch_loose_pile();
  bool is_in_equilibrium();
  void require_heavy() const;
  double displaced() const; ///< of pull and push, along its way [m]
  double way() const;       ///< of push [m]

  const PileCase& case_;
  coupling::CoupledSystem& coupled_;
  coupling::DrivenPile head_;
  PenetrationRate rate_{0.0, 0.0, 0.0, 0.0};
  std::size_t stage_ = 0;
  double time_ = 0.0;          ///< since the start of the stage [s]
  double tip_ = 0.0, x_ = 0.0; ///< at its start [m]
  double force_ = 0.0;         ///< at its start, as modelled [N]
  double largest_force_ = 0.0; ///< so far, of all stages [N]
  std::uint64_t n_steps_ = 0;
  bool has_capacity_ = false;
};

} // namespace mergel::apps
