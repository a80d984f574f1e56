/// Axes of a driven cell that hold a stress: strain rates from the error.
#pragma once

#include "dem/notation.h"

#include <array>
#include <cstddef>

namespace mergel::dem {

/// What one edge of the cell is told for the next step.
struct AxisOrder {
  bool holds_stress = false;
  double stress = 0.0; ///< to hold [Pa], tension positive
  double rate =
      0.0; ///< of strain [1/s]; of an axis that holds a stress what is known ahead
};
using CellOrder = std::array<AxisOrder, 3>;

/// Proportional and integral control of the stress along each edge,
///
///   rate = r + e/(M tau) + I,   dI/dt = e/(M tau_i^2),   e = stress to hold - stress,
///
/// M is the stiffness of the cell if its grains followed the strain (affine_stiffness). The
/// cell's own stiffness is m M with m <= 1, its stress follows d sigma/dt = m M rate + what
/// other axes do, and the error obeys
///
///   e'' + (m/tau) e' + (m/tau_i^2) e = -(what other axes do)'
///
/// with a damping ratio sqrt(m) tau_i/(2 tau): tau_i = 4 tau is critical for m = 1/4 and
/// above it for a stiffer cell. A disturbance at constant rate leaves no error in the mean;
/// it decays over tau_i^2/tau = 16 tau. tau spans `steps` time steps, in which the grains
/// find their places.
struct Servo {
  Vec3 integral = Vec3::Zero();  ///< I [1/s]: state, with what follows
  Vec3 stiffness = Vec3::Zero(); ///< M [Pa], > 0 where a stress is held
  double limit = 0.0;            ///< of a rate [1/s]; there the integral stands still
  double steps = 25.0;           ///< tau over the time step [-]
  std::size_t n_limited = 0;     ///< steps in which an axis met its limit

  /// Rates for the step of dt [s]; the integrals go on by it.
  Vec3 rates(const CellOrder& order, const Vec3& stress, double dt);
};

} // namespace mergel::dem
