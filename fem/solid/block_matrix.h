/// Symmetric matrix of 3x3 blocks whose product with a nodal vector is the far field's hot
/// loop.
#pragma once

#include "fem/nodal.h"

#include <cstdint>

namespace mergel::fem {

/// A = A^T in 3x3 blocks: row i holds block (i, i), then the blocks (i, j) with j > i,
/// columns ascending; nine doubles a block, column by column. Each stored block is read
/// once and serves (i, j) and (j, i), in one fixed order: the product has the same bits on
/// every rank. Measured against PETSc's formats in meshes/README.md.
class BlockMatrix {
public:
  BlockMatrix() = default;

  /// A zero matrix. @param upper for each row, the columns j > i that it couples to,
  /// ascending.
  explicit BlockMatrix(const std::vector<std::vector<std::uint32_t>>& upper);

  /// Add B to block (i, j), i <= j; the block must be in the pattern (throws
  /// std::logic_error).
  void add(std::uint32_t i, std::uint32_t j, const Mat3& B);

  /// y = A x. Both have n_rows() columns; they may not be the same object.
  void multiply(const Nodal& x, Nodal& y) const;

  /// Rows [begin, end) in full: the blocks left of their diagonals are stored in other rows.
  struct Rows {
    struct Left {
      std::size_t block;    ///< the transposed of
      std::uint32_t column; ///< that it multiplies
    };
    std::uint32_t begin = 0, end = 0;
    std::vector<std::size_t> first; ///< of `left`, by row, and the end
    std::vector<Left> left;         ///< columns ascending
  };
  Rows rows(std::uint32_t begin, std::uint32_t end) const;

  /// The same y in these rows, bit for bit; the others stay as they are.
  void multiply(const Nodal& x, Nodal& y, const Rows& rows) const;

  /// Stored or left of the diagonal, by row: what its product costs.
  std::vector<std::size_t> blocks_by_row() const;

  std::uint32_t n_rows() const { return static_cast<std::uint32_t>(row_.size()) - 1; }
  std::size_t n_blocks() const
  {
    return column_.size();
  } ///< stored ones: diagonal and upper

  /// Call f(i, j, block) for every stored block, j >= i, in storage order.
  template <class F>
  void for_each(F&& f) const
  {
    for (std::uint32_t i = 0; i < n_rows(); ++i)
      for (std::size_t k = row_[i]; k < row_[i + 1]; ++k)
        f(i, column_[k], Mat3(Eigen::Map<const Mat3>(value_.data() + 9 * k)));
  }

private:
  std::vector<std::size_t> row_ = {0}; // first block of each row, and the end
  std::vector<std::uint32_t> column_;  // of each block
  std::vector<double> value_ = {
      0, 0}; // nine a block, and a tail that a four-wide load may touch
};

} // namespace mergel::fem
