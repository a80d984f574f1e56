#include "dem/assembly/local_strain.h"

#include "dem/assembly/neighbourhood.h"
#include "dem/pairs/neighbours.h"
#include "dem/parallel/rows.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mergel::dem {

namespace {

constexpr std::size_t fewest = 4; ///< three vectors fit any motion: nothing remains
/// Smallest over largest principal moment of vectors that count as lying in a plane [-].
/// Across it F would magnify whatever is not affine a thousand times.
constexpr double flat = 1e-6;

/// Moments of the vectors from a centre, D in the reference and d at present.
struct Moments {
  Mat3 DD = Mat3::Zero(), dD = Mat3::Zero(); ///< sums of D D^T and d D^T [m^2]
  std::size_t n = 0;

  void add(const Vec3& D, const Vec3& d)
  {
    DD += D * D.transpose();
    dD += d * D.transpose();
    ++n;
  }
  /// All but D2_min.
  DeformationFit fit() const
  {
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(DD);
    const Vec3& moment = principal.eigenvalues(); // ascending
    if (n < fewest || !(moment[0] > flat * moment[2])) return {};
    const Mat3& axes = principal.eigenvectors();
    const Mat3 inverse = axes * moment.cwiseInverse().asDiagonal() * axes.transpose();
    return {dD * inverse, 0.0, n};
  }
};

/// What the fit leaves of one vector, squared [m^2]. The same from the moments would be the
/// small difference of large numbers.
double remainder(const DeformationFit& fit, const Vec3& D, const Vec3& d)
{
  return fit.n > 0 ? (d - fit.F * D).squaredNorm() : 0.0;
}

/// D2_min from the sum of the remainders that it holds.
void divide_by_distances(DeformationFit& fit, const Moments& m)
{
  if (fit.n > 0) fit.D2_min /= m.DD.trace(); // > 0 with an F
}

Particles at(const std::vector<Vec3>& X, const std::vector<double>& R)
{
  Particles p;
  for (std::size_t i = 0; i < X.size(); ++i) {
    ParticleState b;
    b.x = X[i];
    b.R = R[i];
    p.add(b);
  }
  return p;
}

Vec3 centroid(const std::vector<Vec3>& x, const std::vector<Index>& indices)
{
  Vec3 sum = Vec3::Zero();
  for (const Index i : indices) sum += x.at(i);
  return indices.empty() ? sum : Vec3(sum / static_cast<double>(indices.size()));
}

} // namespace

std::vector<Pair> neighbours(const Particles& p, const PeriodicCell& cell,
                             const std::vector<Vec3>& X)
{
  std::vector<double> extra;
  extra.reserve(p.size());
  for (const ParticleState& b : p.state) extra.push_back((neighbour_reach - 1.0) * b.R);
  return find_pairs(p, cell, 0.0, extra, X);
}

std::vector<Pair> neighbours(const std::vector<Vec3>& x, const std::vector<double>& R,
                             const PeriodicCell& cell)
{
  return neighbours(at(x, R), cell);
}

bool holds_neighbourhoods(const PeriodicCell& cell, const Particles& p)
{
  double R = 0.0;
  for (const ParticleState& b : p.state) R = std::max(R, b.R);
  // A hair more than what find_pairs() asks for, which sums the same length otherwise.
  const double needed = 4.0 * (1.0 + 1e-9) * neighbour_reach * R;
  for (const double edge : cell.size)
    if (edge > 0.0 && edge < needed) return false;
  return true;
}

std::vector<DeformationFit> local_deformations(const std::vector<Vec3>& X,
                                               const Particles& p,
                                               const PeriodicCell& cell_0,
                                               const PeriodicCell& cell)
{
  if (X.size() != p.size())
    throw std::logic_error("local_deformations: positions differ in number");
  const std::vector<Pair> pairs = neighbours(p, cell_0, X);
  const auto D = [&](const Pair& q) -> Vec3 {
    return X[q.j] + cell_0.offset(q.shift) - X[q.i];
  };
  const auto d = [&](const Pair& q) -> Vec3 {
    return p.state[q.j].x + cell.offset(q.shift) - p.state[q.i].x;
  };

  // What j sees of i has both signs changed, which leaves products and squares as they are.
  const std::vector<Index> rows = owned_rows(p);
  const auto for_ends = [&](auto&& visit) {
    for (const Pair& q : pairs)
      for (const Index i : {q.i, q.j})
        if (p.owns(i)) visit(rows[i], q);
  };
  std::vector<Moments> moments(p.n_owned());
  for_ends([&](Index k, const Pair& q) { moments[k].add(D(q), d(q)); });
  std::vector<DeformationFit> fits;
  fits.reserve(moments.size());
  for (const Moments& m : moments) fits.push_back(m.fit());
  for_ends(
      [&](Index k, const Pair& q) { fits[k].D2_min += remainder(fits[k], D(q), d(q)); });
  for (std::size_t k = 0; k < fits.size(); ++k) divide_by_distances(fits[k], moments[k]);
  return fits;
}

std::vector<DeformationFit> local_deformations(const std::vector<Vec3>& X,
                                               const std::vector<Vec3>& x,
                                               const std::vector<double>& R,
                                               const PeriodicCell& cell_0,
                                               const PeriodicCell& cell)
{
  if (x.size() != X.size() || R.size() != X.size())
    throw std::logic_error("local_deformations: positions and radii differ in number");
  return local_deformations(X, at(x, R), cell_0, cell);
}

std::vector<Pair> held_neighbours(const Particles& p, const PeriodicCell& cell)
{
  return holds_neighbourhoods(cell, p) ? neighbours(p, cell) : std::vector<Pair>{};
}

std::vector<Mat3> velocity_gradients(const Particles& p, const PeriodicCell& cell,
                                     const std::vector<Pair>& pairs)
{
  const Mat3 of_cell = cell.rate.asDiagonal();
  std::vector<Mat3> all(p.n_owned(), of_cell);
  const std::vector<Index> rows = owned_rows(p);
  std::vector<Moments> moments(p.n_owned());
  for (const Pair& q : pairs) {
    const ParticleState &i = p.state[q.i], &j = p.state[q.j];
    const Vec3 D = j.x + cell.offset(q.shift) - i.x, d = j.v - i.v;
    for (const Index k : {q.i, q.j})
      if (p.owns(k)) moments[rows[k]].add(D, d);
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    if (const DeformationFit fit = moments[k].fit(); fit.n > 0) all[k] += fit.F;
  return all;
}

std::vector<Mat3> velocity_gradients(const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                                     const std::vector<double>& R, const PeriodicCell& cell)
{
  if (v.size() != x.size() || R.size() != x.size())
    throw std::logic_error("velocity_gradients: positions, velocities and radii differ in "
                           "number");
  Particles p = at(x, R);
  for (std::size_t i = 0; i < v.size(); ++i) p.state[i].v = v[i];
  return velocity_gradients(p, cell, held_neighbours(p, cell));
}

DeformationFit deformation_of(const std::vector<Vec3>& X, const std::vector<Vec3>& x,
                              const std::vector<Index>& indices)
{
  const Vec3 C = centroid(X, indices), c = centroid(x, indices);
  Moments moments;
  for (const Index i : indices) moments.add(X[i] - C, x[i] - c);
  DeformationFit fit = moments.fit();
  for (const Index i : indices) fit.D2_min += remainder(fit, X[i] - C, x[i] - c);
  divide_by_distances(fit, moments);
  return fit;
}

double volumetric_strain(const Mat3& F)
{
  return 1.0 - F.determinant();
}

double shear_strain(const Mat3& F)
{
  const Mat3 E = 0.5 * (F.transpose() * F - Mat3::Identity());
  const Mat3 deviator = E - E.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(2.0 / 3.0) * deviator.norm();
}

} // namespace mergel::dem
