#include "dem/element/servo.h"

#include <cmath>

namespace mergel::dem {

Vec3 Servo::rates(const CellControl& control, const Vec3& stress, double dt)
{
  const double tau = steps * dt, tau_i = 4.0 * tau;
  Vec3 rate;
  for (int a = 0; a < 3; ++a) {
    const AxisControl& axis = control[static_cast<std::size_t>(a)];
    if (!axis.holds_stress) {
      rate[a] = axis.rate;
      integral[a] = 0.0;
      continue;
    }
    const double strain = (axis.stress - stress[a]) / stiffness[a]; // stiffness > 0
    const double wanted = axis.rate + strain / tau + integral[a];
    if (std::abs(wanted) <= limit) {
      rate[a] = wanted;
      integral[a] += dt * strain / (tau_i * tau_i);
    } else {
      rate[a] = std::copysign(limit, wanted);
      ++n_limited;
    }
  }
  return rate;
}

} // namespace mergel::dem
