/// Interpolation between the interface nodes of the far field and the nodes of a DEM wall.
#pragma once

#include "dem/math/exact_sum.h"

#include <Eigen/SparseCore>

#include <vector>

namespace mergel::coupling {

using Nodal =
    std::vector<Eigen::Vector3d>; ///< one vector per node, in the order of its mesh

/// Sparse matrix N (coupling/README.md, Transfer): one row per wall node, one column per
/// far-field node.
///   v_dem = N v_fem     consistent: rows of N sum to 1, so a translation stays one
///   f_fem = N^T f_dem   conservative: resultant and interface power are preserved
class Transfer {
public:
  /// @throws std::logic_error when a row does not sum to 1 within round-off
  explicit Transfer(Eigen::SparseMatrix<double, Eigen::RowMajor> N);

  std::size_t n_dem() const { return static_cast<std::size_t>(N_.rows()); }
  std::size_t n_fem() const { return static_cast<std::size_t>(N_.cols()); }

  void to_dem(const Nodal& v_fem, Nodal& v_dem) const; ///< resizes v_dem
  void to_fem(const Nodal& f_dem, Nodal& f_fem) const; ///< resizes f_fem

private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> N_;
};

} // namespace mergel::coupling
