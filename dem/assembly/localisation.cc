#include "dem/assembly/localisation.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace mergel::dem {

namespace {

constexpr double degree = pi / 180.0;
constexpr double grid_step = 4.0 * degree;
constexpr int n_halvings =
    5; ///< of the step, from half of the grid's to an eighth of a degree
constexpr std::size_t n_starts = 4;       ///< normals of the grid that are refined
constexpr double apart = 3.0 * grid_step; ///< of these
constexpr double tenth = 0.1;
constexpr double bins_of_d_50 = 20.0, bins_of_thickness = 100.0;
constexpr double most_bins = 1e6; ///< some debris may be far away
constexpr double round_off = 1e-12;

/// A normal, and its best pair of faces.
struct Candidate {
  Vec3 normal = Vec3::UnitZ();
  double from = 0.0, to = 0.0; ///< [m]
  double excess = 0.0;
};

/// The best faces of one normal after another, from the excess of each particle in bins along it.
class SlabSearch {
public:
  /// @param n_bins of a slab of fixed thickness; 0: any thickness
  SlabSearch(const std::vector<Vec3>& x, const std::vector<double>& weight, double bin,
             std::size_t n_bins)
      : x_(x), weight_(weight), bin_(bin), n_bins_(n_bins), t_(x.size())
  {
    if (weight.size() != x.size() || !(bin > 0.0))
      throw std::logic_error(
          "find_slab: one weight a particle and a resolution are needed");
    total_ = std::accumulate(weight.begin(), weight.end(), 0.0);
    if (!(total_ > 0.0)) return;
    const double of_particle = 1.0 / static_cast<double>(x.size());
    for (const double w : weight) excess_.push_back(w / total_ - of_particle);
  }
  bool has_weight() const { return total_ > 0.0; }

  Candidate across(const Vec3& normal)
  {
    add_up(normal);
    const Window best = n_bins_ > 0 ? best_of_fixed_width() : best_of_any_width();
    return {normal, (first_ + static_cast<double>(best.from)) * bin_,
            (first_ + static_cast<double>(best.to)) * bin_,
            below_[best.to] - below_[best.from]};
  }

  /// The candidate with its shares.
  Slab slab(const Candidate& c) const
  {
    Slab slab{c.normal, c.from, c.to, 0.0, 0.0};
    double n = 0.0, w = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (!slab.holds(x_[i])) continue;
      n += 1.0;
      w += weight_[i];
    }
    slab.share = w / total_;
    slab.even = n / static_cast<double>(x_.size());
    return slab;
  }

private:
  struct Window {
    std::size_t from = 0, to = 0;
  };

  /// Sum of the excess of all that lies below each face.
  void add_up(const Vec3& normal)
  {
    const Vec3 scaled = normal / bin_;
    double low = scaled.dot(x_.front()), high = low;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      t_[i] = scaled.dot(x_[i]);
      low = std::min(low, t_[i]);
      high = std::max(high, t_[i]);
    }
    first_ = std::floor(low);
    const double n = std::floor(high) - first_ + 1.0;
    if (!(n < most_bins))
      throw NumericalError("a particle is far outside of the specimen, in which a band is "
                           "looked for: the run is unstable");
    below_.assign(static_cast<std::size_t>(n) + 1, 0.0);
    for (std::size_t i = 0; i < x_.size(); ++i)
      below_[static_cast<std::size_t>(t_[i] - first_) + 1] += excess_[i];
    for (std::size_t b = 1; b < below_.size(); ++b) below_[b] += below_[b - 1];
  }

  Window best_of_any_width() const
  {
    Window best;
    double largest = 0.0;
    std::size_t lowest = 0;
    for (std::size_t b = 1; b < below_.size(); ++b) {
      if (below_[b] <= below_[lowest]) lowest = b; // the last of equals: no empty bins
      if (below_[b] - below_[lowest] > largest) {
        largest = below_[b] - below_[lowest];
        best = {lowest, b};
      }
    }
    return best;
  }

  Window best_of_fixed_width() const
  {
    const std::size_t n = below_.size() - 1;
    if (n_bins_ >= n) return {0, n};
    Window best{0, n_bins_};
    for (std::size_t b = 1; b + n_bins_ <= n; ++b)
      if (below_[b + n_bins_] - below_[b] > below_[best.to] - below_[best.from])
        best = {b, b + n_bins_};
    return best;
  }

  const std::vector<Vec3>& x_;
  const std::vector<double>& weight_;
  double bin_;
  std::size_t n_bins_;
  double total_ = 0.0, first_ = 0.0; ///< sum of the weights; number of the first bin
  std::vector<double> t_, excess_, below_;
};

Vec3 normal_of(double angle, double azimuth)
{
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
          std::cos(angle)};
}

/// Normals of the half sphere, some grid_step apart.
std::vector<Vec3> grid()
{
  std::vector<Vec3> normals{Vec3::UnitZ()};
  const auto n_rings = static_cast<int>(std::lround(0.5 * pi / grid_step)) + 1;
  for (int k = 1; k <= n_rings; ++k) {
    const double angle = 0.5 * pi * k / n_rings;
    const double way = k == n_rings ? pi : 2.0 * pi; // a vertical plane has two normals
    const auto n = static_cast<int>(std::ceil(way * std::sin(angle) / grid_step));
    for (int j = 0; j < n; ++j) normals.push_back(normal_of(angle, way * j / n));
  }
  return normals;
}

/// The normal turned by `angle` towards eight directions.
std::vector<Vec3> around(const Vec3& normal, double angle)
{
  const Vec3 a = normal.unitOrthogonal(), b = normal.cross(a);
  std::vector<Vec3> normals;
  for (int k = 0; k < 8; ++k) {
    const double phi = 0.25 * pi * k;
    Vec3 n = std::cos(angle) * normal +
             std::sin(angle) * (std::cos(phi) * a + std::sin(phi) * b);
    n.normalize();
    normals.push_back(n.z() < 0.0 ? Vec3(-n) : n);
  }
  return normals;
}

Candidate refine(SlabSearch& search, Candidate best)
{
  double step = 0.5 * grid_step;
  for (int k = 0; k < n_halvings; ++k, step *= 0.5) {
    for (bool moves = true; moves;) {
      moves = false;
      for (const Vec3& normal : around(best.normal, step)) {
        const Candidate c = search.across(normal);
        if (!(c.excess > best.excess)) continue;
        best = c;
        moves = true;
      }
    }
  }
  return best;
}

Slab find(SlabSearch& search)
{
  if (!search.has_weight()) return {};
  std::vector<Candidate> coarse;
  for (const Vec3& normal : grid()) coarse.push_back(search.across(normal));
  std::stable_sort(
      coarse.begin(), coarse.end(),
      [](const Candidate& a, const Candidate& b) { return a.excess > b.excess; });
  std::vector<Candidate> starts;
  for (const Candidate& c : coarse) {
    const bool is_new = std::none_of(starts.begin(), starts.end(), [&](const auto& other) {
      return std::abs(c.normal.dot(other.normal)) > std::cos(apart);
    });
    if (is_new) starts.push_back(c);
    if (starts.size() == n_starts) break;
  }
  Candidate best = refine(search, starts.front());
  for (std::size_t k = 1; k < starts.size(); ++k) {
    const Candidate c = refine(search, starts[k]);
    if (c.excess > best.excess) best = c;
  }
  return search.slab(best);
}

} // namespace

double Slab::angle() const
{
  return std::acos(std::min(1.0, std::abs(normal.z())));
}

double Slab::dip_direction() const
{
  return std::atan2(normal.y(), normal.x());
}

std::vector<double> mark_largest(const std::vector<double>& values, double share)
{
  if (!(share > 0.0 && share <= 1.0))
    throw std::logic_error("mark_largest: the share must be above 0 and at most 1");
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return values[i] > values[j]; });
  std::vector<double> marks(values.size(), 0.0);
  const auto n = static_cast<std::size_t>(
      std::ceil(share * static_cast<double>(values.size()) * (1.0 - round_off)));
  for (std::size_t k = 0; k < n; ++k) marks[order[k]] = 1.0;
  return marks;
}

Slab find_slab(const std::vector<Vec3>& x, const std::vector<double>& weight,
               double resolution)
{
  SlabSearch search(x, weight, resolution, 0);
  return find(search);
}

Slab find_slab_of_thickness(const std::vector<Vec3>& x, const std::vector<double>& weight,
                            double thickness)
{
  SlabSearch search(x, weight, thickness / bins_of_thickness,
                    static_cast<std::size_t>(bins_of_thickness));
  return find(search);
}

Localisation localise(const std::vector<Vec3>& x, const std::vector<double>& strain,
                      double d_50)
{
  std::vector<double> marks = mark_largest(strain, tenth);
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (!(strain[i] > 0.0)) marks[i] = 0.0;
  const double resolution = d_50 / bins_of_d_50;
  Localisation found;
  found.band = find_slab(x, marks, resolution);
  found.of_ten = find_slab_of_thickness(x, marks, 10.0 * d_50);
  std::vector<Vec3> x_rest;
  std::vector<double> marks_rest;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (found.band.holds(x[i])) continue;
    x_rest.push_back(x[i]);
    marks_rest.push_back(marks[i]);
  }
  found.second = find_slab(x_rest, marks_rest, resolution);
  return found;
}

BandAngles band_angles(double phi, double psi)
{
  return {0.25 * pi + 0.5 * phi, 0.25 * pi + 0.5 * psi, 0.25 * (pi + phi + psi)};
}

double dilation_angle(double r)
{
  if (r >= 2.0) return -0.5 * pi; // psi falls to -90 degrees at r = 1 already
  return std::asin(std::clamp(-r / (2.0 - r), -1.0, 1.0));
}

} // namespace mergel::dem
