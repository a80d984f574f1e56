#include "coupling/triaxial/specimen_strain.h"

#include <Eigen/LU>

namespace mergel::coupling {

using dem::Vec3;

MiddleThird::MiddleThird(const std::vector<Vec3>& x_0, double z_bottom, double height)
{
  Vec3 mean = Vec3::Zero();
  for (dem::Index i = 0; i < x_0.size(); ++i) {
    if (std::abs(x_0[i].z() - z_bottom - 0.5 * height) > height / 6.0) continue;
    members_.push_back(i);
    mean += x_0[i];
  }
  require(members_.size() >= 4,
          "Specimen: fewer than four particles in the middle third of "
          "its height: its strain cannot be read");
  mean /= static_cast<double>(members_.size());
  dem::Mat3 squares = dem::Mat3::Zero();
  for (const dem::Index i : members_) {
    X_.push_back(x_0[i] - mean);
    squares += X_.back() * X_.back().transpose();
  }
  inverse_ = squares.inverse();
}

SpecimenStrain MiddleThird::strain(const dem::Assembly& assembly) const
{
  // sum (x - mean x) X^T = sum x X^T, for the mean of X is zero.
  dem::ExactVector<dem::MomentSum> rows[3];
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!assembly.particles.owns(members_[k])) continue;
    const Vec3& x = assembly.particles.state[members_[k]].x;
    for (int a = 0; a < 3; ++a) rows[a].add(x[a] * X_[k]);
  }
  dem::ExactReduction sums;
  for (auto& row : rows) sums.add(row);
  sums.run(assembly.comm);
  dem::Mat3 products;
  for (int a = 0; a < 3; ++a) products.row(a) = rows[a].value().transpose();
  const dem::Mat3 F = products * inverse_;
  return {1.0 - F(2, 2), 1.0 - 0.5 * (F(0, 0) + F(1, 1)), 1.0 - F.determinant()};
}

} // namespace mergel::coupling
