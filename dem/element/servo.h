/// Servo control: strain rates of stress-controlled axes from the error of their stress
/// (dem/README.md, Element tests).
#pragma once

#include "dem/notation.h"

#include <array>
#include <cstddef>

namespace mergel::dem {

/// Control of one axis of the cell in the next step.
struct AxisControl {
  bool holds_stress = false;
  double stress = 0.0; ///< to hold [Pa], tension positive
  double rate = 0.0;   ///< of strain [1/s]; stress-controlled: the part known in advance
};
using CellControl = std::array<AxisControl, 3>;

/// Proportional and integral control of the stress along each edge,
///
///   rate = r + e/(M tau) + I,   dI/dt = e/(M tau_i^2),   e = stress to hold - stress,
///
/// M is the stiffness of the cell if its particles followed the strain (affine_stiffness).
/// The cell's own stiffness is m M with m <= 1, its stress follows d sigma/dt = m M rate +
/// what other axes do, and the error obeys
///
///   e'' + (m/tau) e' + (m/tau_i^2) e = -(what other axes do)'
///
/// with a damping ratio sqrt(m) tau_i/(2 tau): tau_i = 4 tau is critical for m = 1/4 and
/// above critical for a stiffer cell. A disturbance at constant rate leaves no mean error;
/// the error decays over tau_i^2/tau = 16 tau. tau is `steps` time steps, in which the
/// particles rearrange: two periods of the fastest motion.
struct Servo {
  Vec3 integral = Vec3::Zero();  ///< I [1/s]
  Vec3 stiffness = Vec3::Zero(); ///< M [Pa], > 0 on stress-controlled axes
  double limit = 0.0;            ///< of a rate [1/s]; at the limit I does not change
  double steps = 10.0;           ///< tau over the time step [-]
  std::size_t n_limited = 0;     ///< number of rates that were limited, over all steps

  /// Strain rates of a step of dt [s]; advances the integrals by it.
  Vec3 rates(const CellControl& control, const Vec3& stress, double dt);
};

} // namespace mergel::dem
