#include "dem/continuum/section_sums.h"

#include "dem/walls/wall_readings.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace mergel::dem {

SectionSum& SectionSum::operator+=(const SectionSum& b)
{
  volume += b.volume;
  solid += b.solid;
  virial += b.virial;
  displacement += b.displacement;
  increment += b.increment;
  damage += b.damage;
  coordination += b.coordination;
  volumetric += b.volumetric;
  shear += b.shear;
  largest_R = std::max(largest_R, b.largest_R);
  return *this;
}

double SectionAverage::q() const
{
  const Mat3 deviator = stress - stress.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

PrincipalStress SectionAverage::principal() const
{
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(stress);
  const Vec3& sigma = solver.eigenvalues(); // ascending, tension positive
  Vec3 direction = solver.eigenvectors().col(0);
  if (direction.z() < 0.0) direction = -direction;
  return {-sigma[0], -sigma[1], -sigma[2], direction};
}

namespace {

/// Points of a cubic lattice in the unit sphere.
std::vector<Vec3> unit_points()
{
  constexpr int n = 8; // across the diameter
  std::vector<Vec3> points;
  const auto at = [](int k) { return (2.0 * k + 1.0) / n - 1.0; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        if (const Vec3 x(at(i), at(j), at(k)); x.squaredNorm() < 1.0) points.push_back(x);
  return points;
}

/// The places s in (0, 1) where x + s r crosses the plane of this coordinate, multiples of h away
/// from `low`.
void add_planes(std::vector<double>& cuts, double x, double r, double low, double h)
{
  if (r == 0.0) return; // parallel
  const auto [from, to] = std::minmax({(x - low) / h, (x + r - low) / h});
  for (double k = std::ceil(from); k <= to; k += 1.0) cuts.push_back((k * h + low - x) / r);
}

/// The same for the cylinders about the z axis whose radii are multiples of h.
void add_cylinders(std::vector<double>& cuts, const Vec3& x, const Vec3& r, double h)
{
  const double a = r.x() * r.x() + r.y() * r.y();
  if (a == 0.0) return; // vertical
  const double b = (x.x() * r.x() + x.y() * r.y()) / a, c = x.x() * x.x() + x.y() * x.y();
  const double nearest = std::clamp(-b, 0.0, 1.0); // s of the smallest radius
  const auto radius = [&](double s) {
    return std::hypot(x.x() + s * r.x(), x.y() + s * r.y());
  };
  const double lowest = radius(nearest), most = std::max(std::sqrt(c), radius(1.0));
  for (double k = std::max(1.0, std::ceil(lowest / h)); k * h <= most; k += 1.0) {
    const double root = std::sqrt(std::max(0.0, b * b - (c - k * k * h * h) / a));
    cuts.push_back(-b - root);
    cuts.push_back(-b + root);
  }
}

template <class Visit>
void for_each_sum(ExactSectionSum& s, Visit&& visit)
{
  for (EnergySum& component : s.virial) visit(component);
  visit(s.solid);
  visit(s.displacement);
  visit(s.increment);
  visit(s.damage);
  visit(s.coordination);
  visit(s.volumetric);
  visit(s.shear);
}

/// As seen from the other side of the axis: right is left.
SectionSum mirrored(SectionSum sum)
{
  const Vec3 flip(-1.0, 1.0, 1.0);
  sum.virial = (flip.asDiagonal() * sum.virial * flip.asDiagonal()).eval();
  sum.displacement.x() *= -1.0;
  sum.increment.x() *= -1.0;
  return sum;
}

} // namespace

SectionSums::SectionSums(const SectionGrid& grid, const Particles& p,
                         const std::vector<LoadedBranch>& branches,
                         const ParticleValues& values, const RigidWall* pile)
    : grid_(grid), exact_(grid.size()), cells_(grid.size())
{
  const RigidShape* shape = pile ? &pile->shape : nullptr;
  const Vec3 x = pile ? pile->x : Vec3::Zero();
  if (shape) pile_ = *shape;
  z_pile_ = x.z();
  for (int row = 0; row < grid.n_z; ++row)
    for (int column = 0; column < grid.n_columns(); ++column)
      cells_[grid.index(column, row)].volume = grid.volume(column, row, shape, x);
  for (const LoadedBranch& b : branches)
    if (p.owns(b.i)) add(b, p.state[b.i].x);
  std::size_t k = 0;
  p.for_owned([&](Index i) { add(p.state[i], k++, values); });
  round_sums();
}

void SectionSums::add_ranks(const Communicator& comm)
{
  ExactReduction sums;
  std::vector<double> largest_R;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    for_each_sum(exact_[k], [&](auto& sum) { sums.add(sum); });
    largest_R.push_back(cells_[k].largest_R);
  }
  sums.run(comm);
  comm.global_max(largest_R);
  for (std::size_t k = 0; k < cells_.size(); ++k) cells_[k].largest_R = largest_R[k];
  round_sums();
  exact_ = {};
}

void SectionSums::round_sums()
{
  const double h = grid_.h, h3 = h * h * h;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const ExactSectionSum& from = exact_[k];
    SectionSum& to = cells_[k];
    for (int a = 0; a < 9; ++a) to.virial(a) = from.virial[uz(a)].value();
    to.solid = h3 * from.solid.value();
    to.displacement = h3 * h * from.displacement.value();
    to.increment = h3 * h * from.increment.value();
    to.damage = h3 * from.damage.value();
    to.coordination = h3 * from.coordination.value();
    to.volumetric = h3 * from.volumetric.value();
    to.shear = h3 * from.shear.value();
  }
}

void SectionSums::add(const LoadedBranch& b, const Vec3& x)
{
  std::vector<double> cuts{0.0, 1.0};
  add_planes(cuts, x.z(), b.r.z(), grid_.z_low, grid_.h);
  add_planes(cuts, x.x(), b.r.x(), 0.0, std::abs(x.x()) + std::abs(b.r.x()) + grid_.h);
  add_planes(cuts, x.y(), b.r.y(), 0.0, std::abs(x.y()) + std::abs(b.r.y()) + grid_.h);
  add_cylinders(cuts, x, b.r, grid_.h);
  std::erase_if(cuts, [](double s) { return !(s >= 0.0 && s <= 1.0); });
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const double share = cuts[k] - cuts[k - 1];
    if (share <= 0.0) continue;
    const Vec3 middle = x + 0.5 * (cuts[k - 1] + cuts[k]) * b.r;
    const std::ptrdiff_t at = grid_.cell_at(middle);
    if (at < 0) continue;
    const Mat3 axes = section_axes(middle, middle.x() < 0.0);
    const Mat3 virial = share * (axes * b.F) * (axes * b.r).transpose();
    auto& sums = exact_[static_cast<std::size_t>(at)].virial;
    for (int a = 0; a < 9; ++a) sums[uz(a)].add(virial(a));
  }
}

void SectionSums::add(const ParticleState& b, std::size_t k, const ParticleValues& values)
{
  static const std::vector<Vec3> points = unit_points();
  const double share = sphere_mass(b.R, 1.0) / static_cast<double>(points.size());
  std::vector<std::pair<std::ptrdiff_t, double>> found; // cell, volume
  for (const Vec3& point : points) {
    const std::ptrdiff_t at = grid_.cell_at(b.x + b.R * point);
    if (at < 0) continue;
    const auto known = std::find_if(found.begin(), found.end(),
                                    [&](const auto& f) { return f.first == at; });
    if (known == found.end())
      found.push_back({at, share});
    else
      known->second += share;
  }
  const double h = grid_.h;
  for (const auto& [at, volume] : found) {
    const auto cell = static_cast<std::size_t>(at);
    const double v = volume / (h * h * h);
    const int column = static_cast<int>(cell % static_cast<std::size_t>(grid_.n_columns()));
    const Mat3 axes = section_axes(b.x, grid_.is_left(column));
    ExactSectionSum& sum = exact_[cell];
    sum.solid.add(v);
    sum.displacement.add(v / h * (axes * values.displacement[k]));
    sum.increment.add(v / h * (axes * values.increment[k]));
    sum.damage.add(v * values.damage[k]);
    sum.coordination.add(v * values.coordination[k]);
    sum.volumetric.add(v * values.volumetric[k]);
    sum.shear.add(v * values.shear[k]);
    cells_[cell].largest_R = std::max(cells_[cell].largest_R, b.R);
  }
}

bool SectionSums::is_in_pile(double r, double z) const
{
  return pile_ && std::abs(r) < radius_at(*pile_, z - z_pile_);
}

std::optional<SectionSum> SectionSums::filled_window(int column, int row, int reach) const
{
  if (is_in_pile(grid_.r_middle(column), grid_.z_middle(row))) return {};
  const SectionSum sum = window(column, row, reach);
  return is_filled(sum) ? std::optional(sum) : std::nullopt;
}

SectionSum SectionSums::window(int column, int row, int reach) const
{
  SectionSum sum;
  for (int k = std::max(0, row - reach); k <= std::min(grid_.n_z - 1, row + reach); ++k)
    for (int c = std::max(0, column - reach);
         c <= std::min(grid_.n_columns() - 1, column + reach); ++c)
      sum += cell(c, k);
  return sum;
}

SectionSum SectionSums::between(double r_from, double r_to, double z_from,
                                double z_to) const
{
  SectionSum sum;
  for (int row = 0; row < grid_.n_z; ++row) {
    const double z = grid_.z_middle(row);
    if (z < z_from || z >= z_to) continue;
    for (int column = 0; column < grid_.n_columns(); ++column) {
      const double r = std::abs(grid_.r_middle(column));
      if (r < r_from || r >= r_to) continue;
      sum += grid_.is_left(column) ? mirrored(cell(column, row)) : cell(column, row);
    }
  }
  return sum;
}

SectionAverage SectionSums::average(const SectionSum& sum)
{
  SectionAverage a;
  a.stress = 0.5 / sum.volume * (sum.virial + sum.virial.transpose());
  a.porosity = 1.0 - sum.solid / sum.volume;
  a.displacement = sum.displacement / sum.solid;
  a.increment = sum.increment / sum.solid;
  a.damage = sum.damage / sum.solid;
  a.coordination = sum.coordination / sum.solid;
  a.volumetric = sum.volumetric / sum.solid;
  a.shear = sum.shear / sum.solid;
  return a;
}

} // namespace mergel::dem
