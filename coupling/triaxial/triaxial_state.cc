/// Saving and loading a triaxial test: each number by its name.
#include "coupling/triaxial/triaxial_test.h"
#include "dem/io/state/energy_numbers.h"
#include "dem/io/state/stage_numbers.h"

namespace mergel::coupling {

namespace {

template <class State>
dem::NumbersOf<State> numbers_of(State& s)
{
  auto& e = s.start.structures;
  dem::NumbersOf<State> all{
      {"time [s]", &s.time},
      {"height [m]", &s.height},
      {"cell pressure [Pa]", &s.pressure},
      {"axial stress [Pa]", &s.axial},
      {"velocity by the integral of the servo [m/s]", &s.servo_v},
      {"axial strain of the middle third [-]", &s.middle.axial},
      {"lateral strain of the middle third [-]", &s.middle.lateral},
      {"volumetric strain of the middle third [-]", &s.middle.volumetric},
      {"controlled strain since the record [-]", &s.since_record},
      {"largest progress of the stage [-]", &s.largest_progress},
      {"sum of forces on the upper platen since the record [N]", &s.top_sum},
      {"sum of forces on the lower platen since the record [N]", &s.bottom_sum},
      {"sum of the cell pressure since the record [Pa]", &s.pressure_sum},
      {"gross work [J]", &s.gross_work},
      {"work at the record [J]", &s.last_work},
      {"largest strain rate [1/s]", &s.largest_rate},
      {"stiffness before the test [Pa]", &s.stiffness},
      {"density of the rock [kg/m3]", &s.density},
      {"density of the particles [kg/m3]", &s.particle_density},
      {"mean diameter of the particles [m]", &s.mean_diameter},
      {"enclosed volume before the test [m3]", &s.volume_0},
      {"travel of the lower platen before the test [m]", &s.bottom_travel_0},
      {"travel of the upper platen before the test [m]", &s.top_travel_0},
      {"start: kinetic energy of the structures [J]", &e.kinetic},
      {"start: strain energy of the structures [J]", &e.strain},
      {"start: work of the particles [J]", &e.wall_work},
      {"start: applied work [J]", &e.applied_work},
      {"start: damping of the structures [J]", &e.damping}};
  dem::append_stage(all, s.active);
  dem::append_energies(all, "start: ", s.start.assembly);
  dem::append_alarm(all, s.alarm);
  return all;
}

template <class Geometry>
dem::NumbersOf<Geometry> numbers_of_geometry(Geometry& g)
{
  return {{"lower end [m]", &g.z_bottom},
          {"height [m]", &g.height},
          {"area [m2]", &g.area},
          {"void ratio [-]", &g.void_ratio}};
}

template <class State>
dem::CountsOf<State> counts_of(State& s)
{
  dem::CountsOf<State> all{{"stage", &s.stage},
                           {"steps of the stage", &s.n_in_stage},
                           {"steps held after the approach", &s.n_held},
                           {"steps since the record", &s.n_sum},
                           {"rates limited by the servo", &s.n_limited}};
  dem::append_stage_counts(all, s.active);
  return all;
}

} // namespace

void TriaxialTest::save(dem::State& state) const
{
  dem::save_numbers(state, "triaxial_numbers", numbers_of(state_));
  dem::save_numbers(state, "triaxial_geometry", numbers_of_geometry(geometry_));
  dem::save_counts(state, "triaxial_counts", counts_of(state_));
}

void TriaxialTest::load(const dem::State& state)
{
  dem::load_numbers(state, "triaxial_numbers", numbers_of(state_));
  dem::load_numbers(state, "triaxial_geometry", numbers_of_geometry(geometry_));
  dem::load_counts(state, "triaxial_counts", counts_of(state_));
  if (state_.stage >= control_.stages.size())
    dem::State::refuse("triaxial_counts", "names a stage that the case does not have");
}

} // namespace mergel::coupling
