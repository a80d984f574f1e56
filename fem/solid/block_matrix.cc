#include "fem/solid/block_matrix.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace mergel::fem {

BlockMatrix::BlockMatrix(const std::vector<std::vector<std::uint32_t>>& upper)
{
  row_.reserve(upper.size() + 1);
  for (std::uint32_t i = 0; i < upper.size(); ++i) {
    column_.push_back(i);
    column_.insert(column_.end(), upper[i].begin(), upper[i].end());
    row_.push_back(column_.size());
  }
  value_.assign(9 * column_.size() + 2, 0.0);
}

void BlockMatrix::add(std::uint32_t i, std::uint32_t j, const Mat3& B)
{
  const auto begin = column_.begin() + static_cast<std::ptrdiff_t>(row_[i]);
  const auto end = column_.begin() + static_cast<std::ptrdiff_t>(row_[i + 1]);
  const auto found = std::lower_bound(begin, end, j);
  if (found == end || *found != j)
    throw std::logic_error("BlockMatrix::add: block (" + std::to_string(i) + ", " +
                           std::to_string(j) + ") is not in the pattern");
  Eigen::Map<Mat3>(value_.data() + 9 * (found - column_.begin())) += B;
}

namespace {

constexpr NodeLanes zero = {0.0, 0.0, 0.0, 0.0};

NodeLanes node(const NodalField& x, std::size_t a)
{
  NodeLanes lanes;
  std::memcpy(&lanes, x.data() + 4 * a, sizeof lanes);
  return lanes;
}

void set_node(NodalField& y, std::size_t a, NodeLanes lanes)
{
  std::memcpy(y.data() + 4 * a, &lanes, sizeof lanes);
}

/// The columns of a block. The fourth lane holds the next number in memory. It is
/// multiplied by the zero in the fourth entry of a node, or removed at the end of the row.
struct Columns {
  NodeLanes a_0, a_1, a_2;

  explicit Columns(const double* block)
  {
    std::memcpy(&a_0, block, sizeof a_0);
    std::memcpy(&a_1, block + 3, sizeof a_1);
    std::memcpy(&a_2, block + 6, sizeof a_2);
  }
  NodeLanes times(NodeLanes x) const { return a_0 * x[0] + a_1 * x[1] + a_2 * x[2]; }
  /// A^T x: three dot products, summed pairwise.
  NodeLanes transposed_times(NodeLanes x) const
  {
    const NodeLanes t_0 = a_0 * x, t_1 = a_1 * x, t_2 = a_2 * x;
    const NodeLanes s_01 = __builtin_shufflevector(t_0, t_1, 0, 4, 2, 6) +
                           __builtin_shufflevector(t_0, t_1, 1, 5, 3, 7);
    const NodeLanes s_2 = __builtin_shufflevector(t_2, zero, 0, 4, 2, 6) +
                          __builtin_shufflevector(t_2, zero, 1, 5, 3, 7);
    return __builtin_shufflevector(s_01, s_2, 0, 1, 4, 5) +
           __builtin_shufflevector(s_01, s_2, 2, 3, 6, 7);
  }
};

/// y of a row: the sum over the blocks left of the diagonal plus the sum over the others.
NodeLanes whole_row(NodeLanes left, NodeLanes sum)
{
  left += sum;
  left[3] = 0.0;
  return left;
}

} // namespace

void BlockMatrix::multiply(const NodalField& x, NodalField& y) const
{
  y.setZero(4, x.cols());
  for (std::uint32_t i = 0; i < n_rows(); ++i) {
    const NodeLanes x_i = node(x, i);
    NodeLanes sum = zero;
    for (std::size_t k = row_[i]; k < row_[i + 1]; ++k) {
      const Columns A_ij(value_.data() + 9 * k);
      const std::size_t j = column_[k];
      sum += A_ij.times(node(x, j));
      if (j != i) set_node(y, j, node(y, j) + A_ij.transposed_times(x_i));
    }
    set_node(y, i, whole_row(node(y, i), sum));
  }
}

BlockMatrix::Rows BlockMatrix::rows(std::uint32_t begin, std::uint32_t end) const
{
  std::vector<std::vector<Rows::Left>> left(end - begin);
  for (std::uint32_t i = 0; i < end; ++i)
    for (std::size_t k = row_[i] + 1; k < row_[i + 1]; ++k)
      if (column_[k] >= begin && column_[k] < end)
        left[column_[k] - begin].push_back({k, i});

  Rows rows{begin, end, {0}, {}};
  for (const auto& row : left) {
    rows.left.insert(rows.left.end(), row.begin(), row.end());
    rows.first.push_back(rows.left.size());
  }
  return rows;
}

void BlockMatrix::multiply(const NodalField& x, NodalField& y, const Rows& rows) const
{
  for (std::uint32_t i = rows.begin; i < rows.end; ++i) {
    NodeLanes left = zero, sum = zero;
    for (std::size_t l = rows.first[i - rows.begin]; l < rows.first[i - rows.begin + 1];
         ++l)
      left += Columns(value_.data() + 9 * rows.left[l].block)
                  .transposed_times(node(x, rows.left[l].column));
    for (std::size_t k = row_[i]; k < row_[i + 1]; ++k)
      sum += Columns(value_.data() + 9 * k).times(node(x, column_[k]));
    set_node(y, i, whole_row(left, sum));
  }
}

std::vector<std::size_t> BlockMatrix::blocks_by_row() const
{
  std::vector<std::size_t> n(n_rows(), 0);
  for (std::uint32_t i = 0; i < n_rows(); ++i)
    for (std::size_t k = row_[i]; k < row_[i + 1]; ++k) {
      ++n[i];
      if (column_[k] != i) ++n[column_[k]];
    }
  return n;
}

} // namespace mergel::fem
