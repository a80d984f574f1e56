#include "fem/block_matrix.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

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

void BlockMatrix::multiply(const Nodal& x, Nodal& y) const
{
  y.setZero(4, x.cols());
  const double* const xs = x.data();
  double* const ys = y.data();
  const Lanes zero = {0.0, 0.0, 0.0, 0.0};
  const double* a = value_.data();

  for (std::uint32_t i = 0; i < n_rows(); ++i) {
    Lanes x_i;
    std::memcpy(&x_i, xs + 4 * i, sizeof x_i);
    Lanes sum = zero;
    for (std::size_t k = row_[i]; k < row_[i + 1]; ++k, a += 9) {
      // The columns of the block; the fourth lane holds whatever comes next and is
      // multiplied by the zero of x_i below, or cut off when the row is done.
      Lanes a_0, a_1, a_2;
      std::memcpy(&a_0, a, sizeof a_0);
      std::memcpy(&a_1, a + 3, sizeof a_1);
      std::memcpy(&a_2, a + 6, sizeof a_2);

      const std::size_t j = column_[k];
      const double* const x_j = xs + 4 * j;
      sum += a_0 * x_j[0] + a_1 * x_j[1] + a_2 * x_j[2]; // y_i += A_ij x_j
      if (j == i) continue;

      // y_j += A_ij^T x_i: three dot products, summed pairwise
      const Lanes t_0 = a_0 * x_i, t_1 = a_1 * x_i, t_2 = a_2 * x_i;
      const Lanes s_01 = __builtin_shufflevector(t_0, t_1, 0, 4, 2, 6) +
                         __builtin_shufflevector(t_0, t_1, 1, 5, 3, 7);
      const Lanes s_2 = __builtin_shufflevector(t_2, zero, 0, 4, 2, 6) +
                        __builtin_shufflevector(t_2, zero, 1, 5, 3, 7);
      Lanes y_j;
      std::memcpy(&y_j, ys + 4 * j, sizeof y_j);
      y_j += __builtin_shufflevector(s_01, s_2, 0, 1, 4, 5) +
             __builtin_shufflevector(s_01, s_2, 2, 3, 6, 7);
      std::memcpy(ys + 4 * j, &y_j, sizeof y_j);
    }
    Lanes y_i;
    std::memcpy(&y_i, ys + 4 * i, sizeof y_i);
    y_i += sum;
    y_i[3] = 0.0;
    std::memcpy(ys + 4 * i, &y_i, sizeof y_i);
  }
}

} // namespace mergel::fem
