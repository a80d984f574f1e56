/// A Brazilian test: a disc of bonded rock pressed across its diameter between two rigid
/// plates (coupling/README.md, Brazilian test).
#pragma once

#include "coupling/brazilian/disc.h"
#include "coupling/coupled_system.h"

namespace mergel::coupling {

/// Control of a test.
struct BrazilianControl {
  double velocity = 1e-3;    ///< at which the plates approach each other [m/s], > 0
  double strain_limit = 0.0; ///< largest diametral strain [-], > 0
  double final_load = 0.0;   ///< share of the largest load below which the test ends [-]
  double record_every = 0.0; ///< diametral strain [-], > 0
};

/// Contact of the rim with both plates. A strip of Hertz's pressure has half the width
/// 2 sqrt(<(x - <x>)^2>), means weighted with the forces.
struct RimContact {
  double half_angle =
      0.0;                ///< of that strip, seen from the centre; mean of the plates [rad]
  double outermost = 0.0; ///< half angle of the strip that has all contacts [rad]
  std::size_t n = 0;      ///< particles in contact, of both plates
};

/// Half edge of the square at the centre, over which stresses are averaged, over the diameter
/// [-]. It has the whole thickness.
inline constexpr double centre_width = 1.0 / 8.0;

/// One line of history.csv. Forces are means since the last record.
struct BrazilianRecord {
  double time = 0.0;                  ///< [s]
  double approach = 0.0;              ///< of the plates [m]
  double strain = 0.0;                ///< approach over diameter [-]
  double F_top = 0.0, F_bottom = 0.0; ///< of the disc on the plates, outwards [N]
  double load = 0.0;                  ///< mean of both [N]
  RimContact contact;
  PlaneStress centre;                            ///< Love-Weber, |x|, |z| <= D/8 [Pa]
  std::array<std::size_t, n_disc_zones> zones{}; ///< breaks so far
  std::size_t broken = 0;
  std::array<std::size_t, dem::n_break_modes> broken_by{};
  dem::EnergyBalance balance;
  double energy_error = 0.0;                 ///< share of the work [-]
  double unbalanced = 0.0;                   ///< [-]
  double time_step = 0.0, stable_step = 0.0; ///< [s]
};

/// What the end of a test and its summary need of a record.
struct BrazilianPoint {
  double strain = 0.0, load = 0.0;          ///< [-], [N]
  double difference = 0.0;                  ///< of the plate forces, top less bottom [N]
  double half_angle = 0.0, outermost = 0.0; ///< [rad]
  double across = 0.0, along = 0.0;         ///< stresses at the centre [Pa]
  double energy_error = 0.0;                ///< [-]
  std::uint64_t broken = 0;
};

enum class BrazilianOutcome {
  goes_on,
  load_fell, ///< below its share of the largest load
  strain_limit_reached
};

/// Whether the test ends at its last record. The load has to stay below its share for
/// records_of_fall records: a particle that gives way at a plate does not end the test.
BrazilianOutcome outcome(const BrazilianControl& control,
                         const std::vector<BrazilianPoint>& points);
inline constexpr std::size_t records_of_fall = 10;

/// Index of the largest load, the first of equals. @pre there is a point
std::size_t peak_of(const std::vector<BrazilianPoint>& points);

/// What changes during a test, besides the coupled system: plain data.
struct BrazilianState {
  double gap_0 = 0.0;                     ///< between the plates before the test [m]
  double since_record = 0.0;              ///< diametral strain [-]
  double top_sum = 0.0, bottom_sum = 0.0; ///< of forces since the last record [N]
  std::size_t n_sum = 0;
  double gross_work = 0.0, last_work = 0.0; ///< of the plates [J]
  double stiffness = 0.0; ///< of the disc if its particles follow the strain [Pa]
  double density = 0.0;   ///< of the rock [kg/m^3]
  dem::EnergyBalance start;
  dem::EnergyAlarm alarm;
};

class BrazilianTest {
public:
  /// Lay the plates at a disc at rest; collective, as is all below. The system has no
  /// structures; the plates become its rigid walls.
  /// @param control, system must outlive the test
  BrazilianTest(const BrazilianControl& control, const DiscGeometry& disc,
                const dem::ContactLaw& plates, CoupledSystem& system);
  /// Continue from what save() added; the system has plates() as its rigid walls.
  /// @throws InputError when the state is of another test
  BrazilianTest(const BrazilianControl& control, const DiscGeometry& disc,
                CoupledSystem& system, const dem::State& state);
  /// The lower and the upper plate, at the origin.
  static std::vector<dem::RigidWall> plates(const dem::ContactLaw& contact);

  /// @throws Unstable naming what went wrong, the step and the time
  void step();
  bool record_is_due() const { return state_.since_record >= control_.record_every; }
  /// @throws Unstable when the energy balance leaves more than 1 % unexplained
  BrazilianRecord record();

  double strain() const;      ///< diametral [-]
  double wave_stress() const; ///< rho c v of the wave that one plate sends in [Pa]
  const std::vector<BrazilianPoint>& points() const { return points_; } ///< all records
  const std::vector<DiscBreak>& breaks() const { return breaks_; }      ///< in their order
  const BrazilianState& state() const { return state_; }
  const DiscGeometry& disc() const { return disc_; }

  /// Add its own numbers; CoupledSystem::save() adds those of the system.
  void save(dem::State& state) const;
  static std::vector<BrazilianPoint> load_points(const dem::State& state);

private:
  void load(const dem::State& state);
  dem::RigidWall& bottom() const { return system_.assembly.rigid_walls[0]; }
  dem::RigidWall& top() const { return system_.assembly.rigid_walls[1]; }
  double F_top() const { return top().resultant().z(); }
  double F_bottom() const { return -bottom().resultant().z(); }
  double approach() const;
  void collect_breaks();
  RimContact rim_contact() const;

  const BrazilianControl& control_;
  DiscGeometry disc_;
  CoupledSystem& system_;
  BrazilianState state_;
  std::vector<BrazilianPoint> points_;
  std::vector<DiscBreak> breaks_;
};

} // namespace mergel::coupling
