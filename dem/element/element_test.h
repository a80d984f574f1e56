/// An element test: a periodic cell under loading stages, and its records.
#pragma once

#include "dem/assembly/averages.h"
#include "dem/assembly/energy_balance.h"
#include "dem/assembly/mass_scaling.h"
#include "dem/assembly/timestep.h"
#include "dem/element/stress_path.h"

#include <string>

namespace mergel::dem {

/// Control of a test.
struct ElementControl {
  std::vector<LoadingStage> stages;
  double inertial_number = 5e-4;   ///< of the controlled strain [-]
  double reference_pressure = 1e6; ///< smallest |p| in the inertial number [Pa]
  double strain_limit = 0.5;       ///< of the test [-]
  double reversal = 0.5;           ///< share of its progress by which a stress may fall [-]
  double damping = default_damping;                  ///< local damping alpha [-], in [0, 1)
  StepSpec step;                                     ///< rule and safety of the time step
  double inertia_factor = 1.0;                       ///< of the moments of inertia [-], > 0
  double largest_overlap = Motion{}.largest_overlap; ///< at which the test stops [-]
  MassScalingSpec mass_scaling;                      ///< off by default
  bool free_rotation = false;                        ///< of particles without a bond
  double record_every = 2e-4;                        ///< strain [-]
};

/// Particles of a periodic cell and their bonded pairs.
struct PeriodicSpecimen {
  Particles particles;
  PeriodicCell cell;
  std::vector<Pair> bonded;
};

/// Outcome of a stage, or of the test.
enum class Outcome {
  goes_on,      ///< not yet
  done,         ///< the target was reached
  pulled_apart, ///< the specimen failed in tension
  reversed,     ///< the stress fell back before the target: unstable point of the path
  strain_limit_reached, ///< the strain limit was reached first
  unstable              ///< the run went unstable and stopped
};
std::string sentence_of(Outcome outcome);

/// Everything that changes during a run: plain data.
struct ElementState {
  Assembly assembly;
  Servo servo;
  ActiveStage active;
  Vec3 size_0 = Vec3::Zero(); ///< edges before the first stage [m]
  StableStep stable_step;
  EnergyAlarm alarm;
  double dt = 0.0, dt_before = 0.0; ///< [s]
  double time = 0.0;                ///< [s]
  std::size_t stage = 0;            ///< from 0
  std::size_t n_steps = 0, n_in_stage = 0;
  double since_record = 0.0;     ///< controlled strain [-]
  std::size_t n_held = 0;        ///< steps held at the end of an approach
  double largest_progress = 0.0; ///< largest progress of the stage [-]
  double tension = 0.0; ///< largest tension of the controlled axis in the stage [Pa]
  Vec3 stress_sum = Vec3::Zero();  ///< over the steps since the last record [Pa]
  Vec3 held_sum = Vec3::Zero();    ///< of the stresses to hold, over the same steps [Pa]
  std::size_t n_stress = 0;        ///< number of these steps
  double gross_work = 0.0;         ///< of the cell: sum of |work| from record to record [J]
  double last_work = 0.0;          ///< of the cell at the last record [J]
  EnergyBalance start;             ///< before the first stage
  Vec3 stiffness_0 = Vec3::Zero(); ///< affine, before the first stage [Pa]
  double largest_rate = 0.0;       ///< of the controlled strain [1/s]
  double mean_diameter = 0.0;      ///< by mass [m]
  double density = 0.0;            ///< of the particles [kg/m^3]
};

/// One line of history.csv; stresses and strains compression positive.
struct ElementRecord {
  double time = 0.0;
  std::size_t stage = 0; ///< from 0
  SoilState whole;       ///< strains from the start of the test
  SoilState of_stage; ///< strains from the start of the stage, or of the stage it resumes
  bool is_approach = false; ///< during an approach; strains of the stage count from its end
  double controlled_strain = 0.0; ///< of the stage: axial, lateral or volumetric [-]
  CellAverages averages;
  std::size_t broken = 0;
  std::array<std::size_t, n_break_modes> broken_by{};
  EnergyBalance balance;
  double energy_error = 0.0; ///< share of the gross work [-]
  double inertial_number = 0.0, unbalanced = 0.0;
  double time_step = 0.0, stable_step = 0.0; ///< [s]
};

class ElementTest {
public:
  /// Collective, as is all below.
  /// @param control must outlive the test
  /// @throws InputError when no particles touch and none are bonded
  ElementTest(const ElementControl& control, PeriodicSpecimen specimen,
              const PairMaterials& materials, MPI_Comm comm);

  /// Resume from a state within a stage. On every rank its assembly must be a gathered one;
  /// lists are rebuilt.
  ElementTest(const ElementControl& control, ElementState state, MPI_Comm comm);

  /// Begin the stage with this number. If stresses differ from those that the stage is to
  /// hold, the next steps are an approach: is_approaching(). It brings them there at the
  /// rate of the test. Strains of the stage count from the end of the approach.
  void begin_stage(std::size_t stage);
  bool is_approaching() const { return state_.active.is_approaching; }
  /// One step. @throws Unstable naming what went wrong, the step and the time
  void step();
  /// Whether the stage has reached its target, the specimen has failed, or the stage goes
  /// on. Failure is checked when a record is due, in means over the steps since the last
  /// record.
  Outcome outcome() const;
  bool record_is_due() const { return state_.since_record >= control_.record_every; }
  /// Record of the present state; all means start again.
  /// @throws Unstable when the energy balance leaves more than 1 % unexplained
  ElementRecord record();

  const ElementState& state() const { return state_; }
  Assembly& assembly() { return state_.assembly; } ///< to be gathered, not to be changed
  double progress() const { return state_.largest_progress; }

private:
  SoilState soil(const Vec3& sigma) const; ///< strains of the stage
  void approach(double rate);
  void step_unguarded();
  bool is_pulled_apart() const;
  Vec3 stress() const;
  Vec3 mean_stress() const;
  double controlled_rate(const SoilState& now) const;
  void update_stiffness();

  const ElementControl& control_;
  ElementState state_;
};

/// Skin of the lists at S = 1 [m]: default_skin times the smallest diameter at S = 1.
double list_skin(const Particles& p);

} // namespace mergel::dem
