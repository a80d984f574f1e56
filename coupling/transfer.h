/// Interpolation between the interface nodes of a structure and the nodes of its wall.
#pragma once

#include "dem/math/exact_sum.h"

#include <Eigen/SparseCore>

#include <vector>

namespace mergel::coupling {

using Nodal =
    std::vector<Eigen::Vector3d>; ///< one vector per node, in the order of its mesh

/// Sparse matrix N (coupling/README.md, Exchange): one row per wall node, one column per
/// interface node of the structure.
///   v_wall = N v_s      consistent: rows of N sum to 1, so a translation stays one
///   f_s = N^T f_wall    conservative: resultant and interface power are preserved
class Transfer {
public:
  /// @throws std::logic_error when a row does not sum to 1 within round-off
  explicit Transfer(Eigen::SparseMatrix<double, Eigen::RowMajor> N);

  bool is_identity() const { return is_identity_; }
  std::size_t n_wall() const { return static_cast<std::size_t>(N_.rows()); }
  std::size_t n_structure() const { return static_cast<std::size_t>(N_.cols()); }

  void to_wall(const Nodal& v_s, Nodal& v_wall) const;      ///< resizes v_wall
  void to_structure(const Nodal& f_wall, Nodal& f_s) const; ///< resizes f_s

private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> N_;
  bool is_identity_ = false; ///< nothing is to be computed then
};

/// Wall nodes that each follow one node of the structure: a single 1 in each row.
/// @param follows by wall node
Transfer follow(const std::vector<int>& follows, std::size_t n_structure);

} // namespace mergel::coupling
