/// Energy balance of an assembly: growth of the stored energy = input - loss
/// (dem/README.md, Energy balance).
#pragma once

#include "dem/assembly/step.h"

namespace mergel::dem {

/// All terms [J], at the whole step of the positions.
struct EnergyBalance {
  double kinetic = 0.0, bonds = 0.0, contacts = 0.0, walls = 0.0, mirror = 0.0;  ///< stored
  double gravity = 0.0, wall_work = 0.0, rigid_wall_work = 0.0, cell_work = 0.0; ///< input
  double slip = 0.0, plastic = 0.0, breakage_release = 0.0, rotation_constraint = 0.0,
         damping = 0.0; ///< lost

  double stored() const { return kinetic + bonds + contacts + walls + mirror; }
  double input() const { return gravity + wall_work + rigid_wall_work + cell_work; }
  double lost() const
  {
    return slip + plastic + breakage_release + rotation_constraint + damping;
  }
};

/// All terms at the time of the positions. Velocities are half a step behind, so kinetic
/// energy and works are carried over the missing half step by the present forces; the
/// assembly does not move. Otherwise the work of half a step would be missing, which shows
/// when a moving wall first touches a particle. Collective.
/// @param dt present step [s]
EnergyBalance energy_balance(const Assembly& assembly, double dt);

/// Watches the energy error of a run from record to record. Below the stable step it is some
/// 1e-6 in an element test and up to 1e-4 in a pile, whose contacts close at speed; beyond
/// it at once 5e-4 and more, before anything else shows (dem/README.md, Time step).
struct EnergyAlarm {
  static constexpr double large = 3e-4; ///< error that raises the alarm [-]
  static constexpr double rise = 10.0;  ///< from one record to the next, the same [-]
  static constexpr double noise = 1e-5; ///< below it a rise does not count [-]

  double before = 0.0;      ///< error of the last record [-]
  double first_error = 0.0; ///< that raised the alarm [-]; 0: none so far
  double first_time = 0.0;  ///< of that record [s]

  bool is_raised() const { return first_error != 0.0; }
  /// Whether this record raises the alarm; the first time only. @param error signed [-]
  /// @param input since the start, and what was stored then: the alarm waits until the
  ///   input is ten times that, for a share of next to nothing says nothing [J]
  bool add(double error, double time, double input, double stored_at_start);
};

/// Error of the energy balance since `start` [J]: growth of the stored energy - input +
/// loss.
double unexplained(const EnergyBalance& now, const EnergyBalance& start);

} // namespace mergel::dem
