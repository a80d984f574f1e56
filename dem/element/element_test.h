/// An element test: a periodic cell taken through loading stages, and what is recorded of it.
#pragma once

#include "dem/assembly/averages.h"
#include "dem/assembly/energy_balance.h"
#include "dem/element/stress_path.h"

#include <string>

namespace mergel::dem {

/// How the test is controlled.
struct ElementControl {
  std::vector<Leg> legs;
  double inertial_number = 5e-4;   ///< of the driven strain [-]
  double reference_pressure = 1e6; ///< below it the inertial number counts with this [Pa]
  double strain_limit = 0.5;       ///< of the test [-]
  double reversal = 0.5;           ///< of the way made towards a goal [-]
  double damping = 0.7;            ///< local damping alpha [-], in [0, 1)
  double safety = 0.7;             ///< of the time step [-], in (0, 1]
  bool free_rotation = false;      ///< of particles without a bond
  double record_every = 2e-4;      ///< strain [-]
};

/// Particles of a periodic cell and what is bonded.
struct PeriodicSpecimen {
  Particles particles;
  PeriodicCell cell;
  std::vector<Pair> bonded;
};

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
  Rock rock;
  Servo servo;
  Course course;
  Vec3 size_0 = Vec3::Zero();       ///< edges before the first leg [m]
  double dt = 0.0, dt_before = 0.0; ///< [s]
  double time = 0.0;                ///< [s]
  std::size_t leg = 0;              ///< from 0
  std::size_t n_steps = 0, n_in_leg = 0;
  double since_record = 0.0; ///< driven strain [-]
  std::size_t n_held = 0;    ///< steps in which all is held before the leg is driven
  double farthest = 0.0;     ///< greatest progress of the leg [-]
  double tension = 0.0;      ///< greatest tension along the driven axis in the leg [Pa]
  Vec3 stress_sum = Vec3::Zero(); ///< of the steps since the last record [Pa]
  Vec3 held_sum = Vec3::Zero();   ///< what held axes should bear, the same way [Pa]
  std::size_t n_stress = 0;
  double gross_work = 0.0; ///< of the cell, by its magnitude from record to record [J]
  double last_work = 0.0;  ///< of the cell at the last record [J]
  EnergyBook start;        ///< before the first leg
  Vec3 stiffness_0 = Vec3::Zero(); ///< affine, before the first leg [Pa]
  double greatest_rate = 0.0;      ///< of the driven strain [1/s]
  double mean_diameter = 0.0;      ///< by mass [m]
  double density = 0.0;            ///< of the grains [kg/m^3]
};

/// One line of history.csv; stresses and strains compression positive.
struct ElementRecord {
  double time = 0.0;
  std::size_t leg = 0; ///< from 0
  SoilState whole;     ///< strains from the start of the test
  SoilState of_leg;    ///< strains from the start of the leg, or of that which it resumes
  bool is_approach = false;   ///< before the leg is driven; its strains count from later on
  double driven_strain = 0.0; ///< of the leg: axial, lateral or volumetric [-]
  CellAverages averages;
  std::size_t broken = 0;
  std::array<std::size_t, n_break_modes> broken_by{};
  EnergyBook book;
  double energy_error = 0.0; ///< share of the gross work [-]
  double inertial_number = 0.0, unbalanced = 0.0;
};

class ElementTest {
public:
  /// Collective, as is all below.
  /// @param control must outlive the test
  /// @throws InputError when nothing touches and nothing is bonded
  ElementTest(const ElementControl& control, PeriodicSpecimen specimen,
              const PairMaterials& materials, MPI_Comm comm);

  /// Resume from a state in the middle of a leg, the rock of which this rank holds whole;
  /// its lists are made anew.
  ElementTest(const ElementControl& control, ElementState state, MPI_Comm comm);

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
  bool record_is_due() const { return state_.since_record >= control_.record_every; }
  /// The state in numbers, and a new start of all means. @throws Unstable when the energy book
  /// does not close
  ElementRecord record();

  const ElementState& state() const { return state_; }
  Rock& rock() { return state_.rock; } ///< to be brought together, not to be changed
  double progress() const { return state_.farthest; }

private:
  SoilState soil(const Vec3& sigma) const; ///< strains of the leg
  void approach(double rate);
  void step_unguarded();
  bool is_pulled_apart() const;
  Vec3 stress() const;
  Vec3 mean_stress() const;
  double driven_rate(const SoilState& now) const;
  void look_at_stiffness();

  const ElementControl& control_;
  ElementState state_;
};

/// Margin of the lists at S = 1 [m]: usual_skin of the smallest particle.
double list_skin(const Particles& p);

} // namespace mergel::dem
