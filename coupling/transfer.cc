#include "coupling/transfer.h"

#include <cmath>
#include <stdexcept>

namespace mergel::coupling {

namespace {

using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;

std::size_t uz(Eigen::Index i)
{
  return static_cast<std::size_t>(i);
}

} // namespace

Transfer::Transfer(Eigen::SparseMatrix<double, Eigen::RowMajor> N) : N_(std::move(N))
{
  N_.makeCompressed();
  for (Eigen::Index k = 0; k < N_.outerSize(); ++k) {
    double sum = 0.0;
    for (Row entry(N_, k); entry; ++entry) sum += entry.value();
    if (!(std::abs(sum - 1.0) < 1e-12))
      throw std::logic_error("row " + std::to_string(k) +
                             " of the transfer matrix sums to " + std::to_string(sum) +
                             ", not 1");
  }
  is_identity_ = N_.rows() == N_.cols() && N_.nonZeros() == N_.rows();
  for (Eigen::Index k = 0; is_identity_ && k < N_.outerSize(); ++k)
    for (Row entry(N_, k); entry; ++entry)
      is_identity_ = entry.col() == k && entry.value() == 1.0;
}

void Transfer::to_wall(const Nodal& v_s, Nodal& v_wall) const
{
  if (is_identity_) {
    v_wall = v_s;
    return;
  }
  v_wall.assign(n_wall(), Eigen::Vector3d::Zero());
  for (Eigen::Index k = 0; k < N_.outerSize(); ++k)
    for (Row entry(N_, k); entry; ++entry)
      v_wall[uz(k)] += entry.value() * v_s[uz(entry.col())];
}

void Transfer::to_structure(const Nodal& f_wall, Nodal& f_s) const
{
  if (is_identity_) {
    f_s = f_wall;
    return;
  }
  f_s.assign(n_structure(), Eigen::Vector3d::Zero());
  for (Eigen::Index k = 0; k < N_.outerSize(); ++k)
    for (Row entry(N_, k); entry; ++entry)
      f_s[uz(entry.col())] += entry.value() * f_wall[uz(k)];
}

Transfer follow(const std::vector<int>& follows, std::size_t n_structure)
{
  Eigen::SparseMatrix<double, Eigen::RowMajor> N(static_cast<Eigen::Index>(follows.size()),
                                                 static_cast<Eigen::Index>(n_structure));
  for (std::size_t k = 0; k < follows.size(); ++k)
    N.insert(static_cast<Eigen::Index>(k), follows[k]) = 1.0;
  return Transfer(std::move(N));
}

} // namespace mergel::coupling
