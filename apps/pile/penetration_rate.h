/// The penetration rate of a pile.
#pragma once

#include "apps/pile/pile_case.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

/// Velocity of the pile in one push, with a ramp of constant acceleration over 0.05 D at
/// its start and end.
class PenetrationRate {
public:
  /// @param start depth of the tip where the push starts [m], below the end of the case
  explicit PenetrationRate(const PileCase& c, double start = 0.0)
      : v_(c.velocity), ramp_(0.05 * c.diameter), start_(start), travel_(c.travel())
  {
  }
  /// Of a stage from `start` to `end`, with a ramp of this length at both [m].
  PenetrationRate(double v, double ramp, double start, double end)
      : v_(v), ramp_(ramp), start_(start), travel_(end)
  {
  }
  /// Downwards, with the tip at this depth [m/s].
  double velocity(double travelled) const
  {
    // v^2 = 2 a s; at least 1 %, so that the pile starts to move and reaches the end.
    const double s = std::min(travelled - start_, travel_ - travelled);
    return v_ * std::clamp(std::sqrt(std::max(0.0, s) / ramp_), 0.01, 1.0);
  }
  double start() const { return start_; }                  ///< depth of the tip [m]
  double travel() const { return travel_; }                ///< of the tip, total [m]
  double slows_down_at() const { return travel_ - ramp_; } ///< depth of the tip [m]
  double ramp() const { return ramp_; }                    ///< its length [m]

private:
  double v_, ramp_, start_, travel_;
};

} // namespace mergel::apps
