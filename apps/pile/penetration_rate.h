/// The penetration rate of a pile.
#pragma once

#include "apps/pile/pile_case.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

/// Velocity of the pile, with a ramp of constant acceleration over 0.05 D at start and end.
class PenetrationRate {
public:
  explicit PenetrationRate(const PileCase& c)
      : v_(c.velocity), ramp_(0.05 * c.diameter), travel_(c.travel())
  {
  }
  /// Downwards, with the tip at this depth [m/s].
  double velocity(double travelled) const
  {
    // v^2 = 2 a s; at least 1 %, so that the pile starts to move and reaches the end.
    const double s = std::min(travelled, travel_ - travelled);
    return v_ * std::clamp(std::sqrt(std::max(0.0, s) / ramp_), 0.01, 1.0);
  }
  double travel() const { return travel_; }                ///< of the tip, total [m]
  double slows_down_at() const { return travel_ - ramp_; } ///< depth of the tip [m]
  double ramp() const { return ramp_; }                    ///< its length [m]

private:
  double v_, ramp_, travel_;
};

} // namespace mergel::apps
