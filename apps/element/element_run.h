/// A rock led along the legs of an element test, and what is recorded of it.
#pragma once

#include "apps/element/element_case.h"
#include "dem/assembly/energy_balance.h"
#include "dem/collective_failure.h"
#include "dem/io/state/state_file.h"

namespace mergel::apps {

/// How a leg, or the test, came to its end.
enum class Outcome {
  goes_on,      ///< not yet
  done,         ///< the goal was reached
  pulled_apart, ///< the specimen failed in tension: nothing is left to pull at
  reversed,     ///< the stress fell back on its way: the path met an unstable point
  gave_up,      ///< the strain limit came first
  broke_off     ///< the run went unstable and stopped
};
std::string sentence_of(Outcome outcome);

/// All that changes in a run: plain state.
struct ElementState {
  dem::Rock rock;
  dem::Servo servo;
  dem::Course course;
  dem::Vec3 size_0 = dem::Vec3::Zero(); ///< edges before the first leg [m]
  double dt = 0.0, dt_before = 0.0;     ///< [s]
  double time = 0.0;                    ///< [s]
  std::size_t leg = 0;                  ///< from 0
  std::size_t n_steps = 0, n_in_leg = 0;
  double since_record = 0.0; ///< driven strain [-]
  std::size_t n_held = 0;    ///< steps in which all is held before the leg is driven
  double farthest = 0.0;     ///< greatest progress of the leg [-]
  double tension = 0.0;      ///< greatest tension along the driven axis in the leg [Pa]
  dem::Vec3 stress_sum = dem::Vec3::Zero(); ///< of the steps since the last record [Pa]
  dem::Vec3 held_sum = dem::Vec3::Zero(); ///< what held axes should bear, the same way [Pa]
  std::size_t n_stress = 0;
  double gross_work = 0.0; ///< of the cell, by its magnitude from record to record [J]
  double last_work = 0.0;  ///< of the cell at the last record [J]
  dem::EnergyBook start;   ///< before the first leg
  dem::Vec3 stiffness_0 = dem::Vec3::Zero(); ///< affine, before the first leg [Pa]
  double greatest_rate = 0.0;                ///< of the driven strain [1/s]
};

/// One line of history.csv; stresses and strains compression positive.
struct ElementRecord {
  double time = 0.0;
  std::size_t leg = 0;   ///< from 0
  dem::SoilState whole;  ///< strains from the start of the test
  dem::SoilState of_leg; ///< strains from the start of the leg, or of that which it resumes
  bool is_approach = false;   ///< before the leg is driven; its strains count from later on
  double driven_strain = 0.0; ///< of the leg: axial, lateral or volumetric [-]
  dem::CellAverages averages;
  std::size_t broken = 0;
  std::array<std::size_t, dem::n_break_modes> broken_by{};
  dem::EnergyBook book;
  double energy_error = 0.0; ///< share of the gross work [-]
  double inertial_number = 0.0, unbalanced = 0.0;
};

class ElementRun {
public:
  /// Collective, as is all below.
  ElementRun(const ElementCase& c, ElementRock rock, const dem::PairMaterials& materials);

  /// As it was when put() wrote the state, in the middle of a leg.
  /// @throws InputError when the state is of another run
  ElementRun(const ElementCase& c, dem::State& state);

  void put(dem::State& state) const;

  /// Set out on the leg of this number. Stresses that it holds may be elsewhere: the steps
  /// then bring them there first, at the rate of the test, while is_approaching(); strains
  /// of the leg count from the end of that.
  void set_out(std::size_t leg);
  bool is_approaching() const { return state_.course.is_approaching; }
  /// One step. @throws Unstable naming what went wrong, the step and the time
  void step();
  /// Re-evaluate the critical step; lower the time step if it fell. Collective.
  void lower_time_step();
  /// Whether the leg's goal is met, the rock failed, or it goes on. Failure is looked for
  /// when a record is due, in means over the steps since the last.
  Outcome outcome() const;
  bool record_is_due() const { return state_.since_record >= case_.record_every; }
  /// The state in numbers, and a new start of all means. @throws Unstable when the energy book
  /// does not close
  ElementRecord record();

  const ElementState& state() const { return state_; }
  dem::Rock& rock() { return state_.rock; } ///< to be brought together, not to be changed
  double progress() const { return state_.farthest; }

private:
  dem::SoilState soil(const dem::Vec3& sigma) const; ///< strains of the leg
  void approach(double rate);
  void step_unguarded();
  bool is_pulled_apart() const;
  dem::Vec3 stress() const;
  dem::Vec3 mean_stress() const;
  double driven_rate(const dem::SoilState& now) const;
  void look_at_stiffness();

  const ElementCase& case_;
  ElementState state_;
  double d_ = 0.0, rho_ = 0.0; ///< mean diameter by mass [m], density of grains [kg/m^3]
};

/// What was recorded so far, for the analysis of the legs.
void put(dem::State& state, const std::vector<ElementRecord>& records);
std::vector<ElementRecord> take_records(const dem::State& state);

} // namespace mergel::apps
