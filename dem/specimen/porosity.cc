#include "dem/specimen/porosity.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

/// Points of a cubic grid, and which of them lie in a sphere.
class Raster {
public:
  /// @param h spacing [m]
  Raster(const Bounds& box, double h) : low_(box.low), h_(h)
  {
    for (int a = 0; a < 3; ++a)
      n_[a] = static_cast<long>((box.high[a] - box.low[a]) / h) + 1;
    solid_.assign(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]), false);
  }

  void fill(const ParticleState& b)
  {
    const Vec3 c = (b.x - low_) / h_;
    const double R = b.R / h_;
    const auto range = [&](int a, double half) {
      const double last = static_cast<double>(n_[a] - 1);
      return std::pair(static_cast<long>(std::ceil(std::max(0.0, c[a] - half))),
                       static_cast<long>(std::floor(std::min(last, c[a] + half))));
    };
    const auto [k_first, k_last] = range(2, R);
    for (long k = k_first; k <= k_last; ++k) {
      const double z = static_cast<double>(k) - c.z();
      const double disc2 = R * R - z * z;
      const auto [j_first, j_last] = range(1, std::sqrt(std::max(0.0, disc2)));
      for (long j = j_first; j <= j_last; ++j) {
        const double y = static_cast<double>(j) - c.y();
        const auto [first, last] = range(0, std::sqrt(std::max(0.0, disc2 - y * y)));
        const auto row = solid_.begin() + index(0, j, k);
        if (first <= last) std::fill(row + first, row + last + 1, true);
      }
    }
  }

  struct Count {
    std::ptrdiff_t points = 0, solid = 0;
  };
  /// Points of a convex set, and those of them in a sphere. In a row they lie side by side,
  /// so only the points beside them are tested.
  template <class IsInside>
  Count count(IsInside&& is_inside) const
  {
    Count c;
    for (long k = 0; k < n_[2]; ++k)
      for (long j = 0; j < n_[1]; ++j) {
        const auto is_in = [&](long i) { return is_inside(Vec3(low_ + h_ * at(i, j, k))); };
        long first = 0, end = n_[0];
        while (first < end && !is_in(first)) ++first;
        while (end > first && !is_in(end - 1)) --end;
        const auto row = solid_.begin() + index(0, j, k);
        c.points += end - first;
        c.solid += std::count(row + first, row + end, true);
      }
    return c;
  }

private:
  static Vec3 at(long i, long j, long k)
  {
    return {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }
  long index(long i, long j, long k) const { return (k * n_[1] + j) * n_[0] + i; }

  Vec3 low_;
  double h_;
  long n_[3];
  std::vector<bool> solid_;
};

} // namespace

double solid_volume(const Particles& p)
{
  double v = 0.0;
  for (const ParticleState& b : p.state) v += sphere_mass(b.R, 1.0);
  return v;
}

double core_porosity(const Region& region, const Particles& p)
{
  if (std::holds_alternative<PeriodicBox>(region))
    return 1.0 - solid_volume(p) / volume(region);

  double d_smallest = std::numeric_limits<double>::infinity(), margin = 0.0;
  for (const ParticleState& b : p.state) {
    d_smallest = std::min(d_smallest, 2.0 * b.R);
    margin = std::max(margin, 2.0 * b.R);
  }
  // 1e8 points are enough for any region: they give 1e-4 of its volume to three digits.
  const Bounds box = bounds(region);
  const double h = std::max(0.1 * d_smallest, std::cbrt((box.high - box.low).prod() / 1e8));
  Raster raster(box, h);
  for (const ParticleState& b : p.state) raster.fill(b);
  const Raster::Count core = std::visit(
      [&](const auto& shape) {
        return raster.count([&](const Vec3& x) { return is_inside_by(shape, x, margin); });
      },
      region);
  require(core.points > 0,
          "the region has no core: it must be wider than three of the largest particles");
  return 1.0 - static_cast<double>(core.solid) / static_cast<double>(core.points);
}

} // namespace mergel::dem
