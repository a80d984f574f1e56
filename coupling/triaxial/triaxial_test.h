/// A triaxial test: bonded rock between two platens, in a membrane under a cell pressure or in
/// none, along loading stages (coupling/README.md, Triaxial test).
#pragma once

#include "coupling/coupled_system.h"
#include "coupling/membrane_structure.h"
#include "coupling/triaxial/specimen_strain.h"
#include "dem/element/element_test.h"

#include <string>

namespace mergel::coupling {

/// Control of a test. Of an element test it has the stages, and what limits a rate; the time
/// step is that of the coupled system.
struct TriaxialControl : dem::ElementControl {
  /// Largest stress rho c v of the wave that a platen of the velocity v sends into the specimen
  /// [Pa]; c is the wave speed of the specimen if its particles follow the strain.
  double wave_stress = 4e4;
};

/// Geometry of the specimen before the test.
struct SpecimenGeometry {
  double z_bottom = 0.0, height = 0.0; ///< [m]
  double area = 0.0;                   ///< of the cross-section [m^2]
  double void_ratio = 0.0;             ///< of its core [-]
};

/// What a membrane does, at one time.
struct MembraneRecord {
  double volume = 0.0;      ///< enclosed by membrane and platens [m^3]
  double strain = 0.0;      ///< volumetric, of that volume, compression positive [-]
  double penetration = 0.0; ///< that strain less the one of the middle third [-]
  double axial = 0.0;       ///< axial stress that it carries, over the specimen's area [Pa]
  double hoop = 0.0;        ///< lateral stress by its hoop tension [Pa]
  double delivered = 0.0;   ///< mean pressure of the membrane on the particles [Pa]
  double wrinkled = 0.0;    ///< share of its triangles that wrinkle or are slack [-]
  double stretch = 1.0;     ///< the largest [-]
  std::size_t n_folds = 0;  ///< of more than 90 degrees
};

/// One line of history.csv. Stresses and strains compression positive; forces and stresses of
/// the platens are means since the last record.
struct TriaxialRecord {
  double time = 0.0;     ///< [s]
  std::size_t stage = 0; ///< from 0
  bool is_approach = false;
  dem::SoilState whole; ///< axial strain of the platens, lateral one of the middle third
  dem::SoilState of_stage;
  double controlled_strain = 0.0;
  SpecimenStrain middle;                           ///< of the middle third
  double cell_pressure = 0.0;                      ///< as applied [Pa]
  double middle_axial = 0.0, middle_lateral = 0.0; ///< stress of the middle third [Pa]
  double q_raw = 0.0;                              ///< with what the membrane carries [Pa]
  double F_top = 0.0, F_bottom = 0.0;              ///< of the particles on the platens [N]
  double tilt = 0.0;                               ///< of the upper platen [rad]
  double void_ratio = 0.0;                         ///< of the middle third [-]
  MembraneRecord membrane;
  std::size_t broken = 0;
  std::array<std::size_t, dem::n_break_modes> broken_by{};
  EnergyBalances balance;
  double energy_error = 0.0; ///< share of the gross work [-]
  InterfaceBalance interface;
  double inertial_number = 0.0, unbalanced = 0.0;
  double time_step = 0.0, stable_step = 0.0; ///< [s]
};

/// What changes during a test, besides the coupled system: plain data.
struct TriaxialState {
  dem::ActiveStage active;
  std::size_t stage = 0, n_in_stage = 0, n_held = 0;
  double time = 0.0;     ///< [s]
  double height = 0.0;   ///< between the platens [m]
  double pressure = 0.0; ///< in the cell [Pa]
  double axial = 0.0;    ///< mean stress of both platens, over some transits of a wave [Pa]
  SpecimenStrain middle; ///< at the last reading
  double servo_v = 0.0;  ///< velocity of the platens by the integral of the servo [m/s]
  double since_record = 0.0; ///< controlled strain [-]
  double largest_progress = 0.0;
  double top_sum = 0.0, bottom_sum = 0.0; ///< of forces since the last record [N]
  double pressure_sum = 0.0;              ///< the same of the cell pressure [Pa]
  std::size_t n_sum = 0;
  double gross_work = 0.0, last_work = 0.0; ///< of platens and pressure [J]
  double largest_rate = 0.0;                ///< [1/s]
  std::size_t n_limited = 0; ///< steps in which the servo wanted more than its largest rate
  double stiffness = 0.0;    ///< of the specimen if its particles follow the strain [Pa]
  double density = 0.0, particle_density = 0.0; ///< of the rock, of the particles [kg/m^3]
  double mean_diameter = 0.0;                   ///< by mass [m]
  double volume_0 = 0.0;                        ///< enclosed before the test [m^3]
  double bottom_travel_0 = 0.0, top_travel_0 = 0.0; ///< of the platens before it [m]
  EnergyBalances start;
  dem::EnergyAlarm alarm;
};

class TriaxialTest {
public:
  /// A specimen at rest in stress-free contact; collective, as is all below. The structures of
  /// the system are the lower platen, the upper one and, if there is one, the membrane.
  /// @param control, system must outlive the test
  TriaxialTest(const TriaxialControl& control, const SpecimenGeometry& geometry,
               CoupledSystem& system);
  /// Continue from the numbers of save(). @throws InputError when they are of another test
  TriaxialTest(const TriaxialControl& control, const SpecimenGeometry& geometry,
               CoupledSystem& system, const dem::State& state);

  /// Particles without bonds, packed under this pressure between rigid walls, come to rest in
  /// the membrane under it: first the membrane against held particles, then all together.
  /// The test begins there: all strains and volumes count from this state. To be called once,
  /// before the first stage.
  /// @param pressure in the cell and of the platens [Pa], > 0
  /// @throws Unstable when they do not come to rest
  void seat(double pressure);

  /// As in an element test (dem/element/element_test.h).
  void begin_stage(std::size_t stage);
  bool is_approaching() const { return state_.active.is_approaching; }
  /// @throws Unstable naming what went wrong, the step and the time
  void step();
  dem::Outcome outcome() const;
  bool record_is_due() const { return state_.since_record >= control_.record_every; }
  /// @throws Unstable when the energy balance leaves more than 1 % unexplained
  TriaxialRecord record();
  double progress() const { return state_.largest_progress; }

  const TriaxialState& state() const { return state_; }
  /// Of the specimen where the test begins.
  const SpecimenGeometry& geometry() const { return geometry_; }
  bool has_membrane() const { return membrane_ != nullptr; }
  const MembraneStructure& membrane() const { return *membrane_; }
  CoupledSystem& system() { return system_; }

  /// Add its own numbers; CoupledSystem::save() adds those of the system.
  void save(dem::State& state) const;

private:
  void load(const dem::State& state);
  void begin_here();
  void find_structures();
  double height() const;
  double area() const; ///< of the cross-section now [m^2]
  dem::Vec3 size() const;
  dem::Vec3 size_0() const;
  double platen_stress() const;
  dem::SoilState soil(double axial_stress) const;
  dem::SoilState soil(double axial_stress, double lateral, const dem::Vec3& size_0) const;
  double full_rate(const dem::SoilState& now) const;
  double wave_speed() const;
  bool is_consolidated() const;
  void control(double rate);
  void approach(double rate);
  void read_strain();
  void require_inside() const;
  MembraneRecord membrane_record() const;

  const TriaxialControl& control_;
  SpecimenGeometry geometry_;
  CoupledSystem& system_;
  RigidPlaten* bottom_ = nullptr;
  RigidPlaten* top_ = nullptr;
  MembraneStructure* membrane_ = nullptr; ///< none in an unconfined test
  MiddleThird middle_;
  TriaxialState state_;
};

} // namespace mergel::coupling
