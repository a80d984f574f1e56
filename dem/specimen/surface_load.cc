#include "dem/specimen/surface_load.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

/// Vertical lines in a square grid over the plan of a prism, mirror symmetric in x and y, and
/// the particle that each meets first.
class Lines {
public:
  Lines(const Bounds& b, double spacing)
      : h_(spacing), n_x_(static_cast<std::ptrdiff_t>(std::ceil(b.high.x() / spacing))),
        n_y_(static_cast<std::ptrdiff_t>(std::ceil(b.high.y() / spacing))),
        top_(4 * static_cast<std::size_t>(n_x_) * static_cast<std::size_t>(n_y_),
             -std::numeric_limits<double>::infinity()),
        first_(top_.size(), nobody)
  {
  }

  void add(const ParticleState& b, Index i)
  {
    for (std::ptrdiff_t k = from(b.x.x() - b.R, n_x_); k <= to(b.x.x() + b.R, n_x_); ++k)
      for (std::ptrdiff_t l = from(b.x.y() - b.R, n_y_); l <= to(b.x.y() + b.R, n_y_);
           ++l) {
        const double dx = at(k) - b.x.x(), dy = at(l) - b.x.y();
        const double z2 = b.R * b.R - dx * dx - dy * dy;
        if (z2 < 0.0) continue;
        const std::size_t line = number(k, l);
        const double z = b.x.z() + std::sqrt(z2);
        if (z <= top_[line]) continue;
        top_[line] = z;
        first_[line] = i;
      }
  }

  /// Call visit(x of a line at z = 0, first particle) for the lines that meet one.
  template <class Visit>
  void visit(Visit&& visit) const
  {
    for (std::ptrdiff_t k = -n_x_; k < n_x_; ++k)
      for (std::ptrdiff_t l = -n_y_; l < n_y_; ++l)
        if (first_[number(k, l)] != nobody)
          visit(Vec3(at(k), at(l), 0.0), first_[number(k, l)]);
  }

private:
  static constexpr Index nobody = std::numeric_limits<Index>::max();

  double at(std::ptrdiff_t k) const { return (static_cast<double>(k) + 0.5) * h_; }
  std::ptrdiff_t from(double x, std::ptrdiff_t n) const
  {
    return std::max(-n, static_cast<std::ptrdiff_t>(std::floor(x / h_)));
  }
  std::ptrdiff_t to(double x, std::ptrdiff_t n) const
  {
    return std::min(n - 1, static_cast<std::ptrdiff_t>(std::floor(x / h_)));
  }
  std::size_t number(std::ptrdiff_t k, std::ptrdiff_t l) const
  {
    return static_cast<std::size_t>((k + n_x_) * 2 * n_y_ + (l + n_y_));
  }

  double h_;
  std::ptrdiff_t n_x_, n_y_;
  std::vector<double> top_;  ///< highest point of a particle on the line [m]
  std::vector<Index> first_; ///< by line
};

template <class Prism>
std::vector<Vec3> load_on(const Prism& prism, const Particles& p, double pressure)
{
  // A particle is seen at some 50 lines or more.
  double R = prism.radius;
  for (const ParticleState& b : p.state) R = std::min(R, b.R);
  Lines lines(bounds(Region(prism)), R / 4.0);
  for (Index i = 0; i < p.size(); ++i) lines.add(p.state[i], i);

  std::vector<double> n(p.size(), 0.0);
  double sum = 0.0;
  const Vec3 half_way(0.0, 0.0, -0.5 * prism.height);
  lines.visit([&](const Vec3& x, Index i) {
    if (!is_inside_by(prism, x + half_way, 1e-9 * prism.radius)) return;
    n[i] += 1.0;
    sum += 1.0;
  });
  if (sum == 0.0) throw InputError("surcharge: the specimen has no particle to load");
  const double per_line = pressure * volume(Region(prism)) / prism.height / sum;
  std::vector<Vec3> f;
  f.reserve(p.size());
  for (const double share : n) f.emplace_back(0.0, 0.0, -per_line * share);
  return f;
}

std::vector<Vec3> load_on(const PeriodicBox&, const Particles&, double)
{
  throw InputError("surcharge: a periodic box has no free surface");
}

} // namespace

std::vector<Vec3> surface_load(const Particles& p, const Region& region, double pressure)
{
  return std::visit([&](const auto& shape) { return load_on(shape, p, pressure); }, region);
}

} // namespace mergel::dem
