/// Symmetric matrix of 3x3 blocks. Its product with a nodal vector is most of the cost of a
/// far-field step (fem/README.md, The product K u).
#pragma once

#include "fem/nodal.h"

#include <cstdint>

namespace mergel::fem {

/// A = A^T in 3x3 blocks: row i holds block (i, i), then the blocks (i, j) with j > i,
/// columns ascending; nine doubles per block, column by column. Each stored block is read
/// once and used for (i, j) and (j, i), in one fixed order: the product has the same bits
/// on every rank. meshes/README.md compares its cost with PETSc's formats.
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
  void multiply(const NodalField& x, NodalField& y) const;

  /// Rows [begin, end) with the blocks left of their diagonals, which are stored in other
  /// rows.
  struct Rows {
    struct Left {
      std::size_t block;    ///< stored block, to be transposed
      std::uint32_t column; ///< column of the transposed block
    };
    std::uint32_t begin = 0, end = 0;
    std::vector<std::size_t> first; ///< index into `left` of each row's first, and the end
    std::vector<Left> left;         ///< columns ascending
  };
  Rows rows(std::uint32_t begin, std::uint32_t end) const;

  /// The same y, bit for bit, in these rows only; other rows of y are unchanged.
  void multiply(const NodalField& x, NodalField& y, const Rows& rows) const;

  /// Number of blocks of each row, those left of the diagonal included: the cost of its
  /// product.
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
  // Nine per block, and two more that the load of four numbers may read.
  std::vector<double> value_ = {0, 0};
};

} // namespace mergel::fem
