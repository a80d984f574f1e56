#include "fem/far_field/far_field_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mergel::fem {
namespace {

/// Number of cells that fill a length, at least one. The first has the given size, each
/// further one `growth` times the size before.
int n_graded(double length, double size, double growth)
{
  const double ratio = length / size;
  const double n =
      growth - 1.0 < 1e-6 ? ratio : std::log1p(ratio * (growth - 1.0)) / std::log(growth);
  return std::max(1, static_cast<int>(std::lround(std::min(n, 1e6))));
}

} // namespace

FarFieldGeometry geometry(const FarFieldSpec& s)
{
  return {s.chamber_diameter / 2.0,
          s.chamber_height,
          s.region_diameter / 2.0,
          s.region_height,
          s.cell_size,
          s.growth,
          s.extent};
}

double FarFieldLayers::n_cells(Extent extent) const
{
  const double around = n_around;
  const double core = around / 2.0 * (around / 4.0) + around * n_ring;
  const double of_half = around * n_radial * (n_upper + n_lower) + core * n_lower;
  return extent == Extent::full ? 2.0 * of_half : of_half;
}

FarFieldLayers layers(const FarFieldGeometry& g)
{
  const auto nearest = [](double cells) {
    return static_cast<int>(std::lround(std::clamp(cells, 1.0, 1e6)));
  };
  FarFieldLayers n{};
  const double around = std::numbers::pi * g.region_radius / g.cell_size;
  n.n_around = std::max(8, 4 * nearest(around / 4.0));
  // The rim of the core is at 0.6 to 0.72 R_d: about a third of R_d is left for the rings.
  n.n_ring = nearest(n.n_around / (3.0 * std::numbers::pi));
  n.n_radial = n_graded(g.chamber_radius - g.region_radius, g.cell_size, g.growth);
  n.n_upper = nearest(g.region_height / g.cell_size);
  n.n_lower = n_graded(g.chamber_height - g.region_height, g.cell_size, g.growth);
  return n;
}

} // namespace mergel::fem
