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
}

void Transfer::to_dem(const Nodal& v_fem, Nodal& v_dem) const
{
  v_dem.assign(n_dem(), Eigen::Vector3d::Zero());
  for (Eigen::Index k = 0; k < N_.outerSize(); ++k)
    for (Row entry(N_, k); entry; ++entry)
      v_dem[uz(k)] += entry.value() * v_fem[uz(entry.col())];
}

void Transfer::to_fem(const Nodal& f_dem, Nodal& f_fem) const
{
  f_fem.assign(n_fem(), Eigen::Vector3d::Zero());
  for (Eigen::Index k = 0; k < N_.outerSize(); ++k)
    for (Row entry(N_, k); entry; ++entry)
      f_fem[uz(entry.col())] += entry.value() * f_dem[uz(k)];
}

} // namespace mergel::coupling
