#include "fem/membrane/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mergel::fem {

using std::numbers::pi;

Tube Tube::with_node_distance(double radius, double z_bottom, double height,
                              double distance)
{
  const auto n = [](double length, double part) {
    return static_cast<int>(std::lround(std::min(length / part, 1e6)));
  };
  return {radius, z_bottom, height, std::max(3, n(2.0 * pi * radius, distance)),
          std::max(1, n(height, 0.5 * std::sqrt(3.0) * distance))};
}

double Tube::node_distance() const
{
  const double chord = 2.0 * radius * std::sin(pi / n_around), row = height / n_high,
               half = 2.0 * radius * std::sin(0.5 * pi / n_around);
  return std::max(chord, std::hypot(row, half));
}

} // namespace mergel::fem
