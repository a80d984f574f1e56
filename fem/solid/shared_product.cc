#include "fem/solid/shared_product.h"

#include <numeric>

namespace mergel::fem {

SharedProduct::SharedProduct(const BlockMatrix& A, MPI_Comm comm) : A_(A), comm_(comm)
{
  int rank = 0, n_ranks = 1;
  if (comm_ != MPI_COMM_NULL) {
    MPI_Comm_rank(comm_, &rank);
    MPI_Comm_size(comm_, &n_ranks);
  }
  if (n_ranks == 1) {
    comm_ = MPI_COMM_NULL;
    return;
  }

  // Each rank gets consecutive rows with its share of all blocks.
  const std::vector<std::size_t> n_blocks = A.blocks_by_row();
  const std::size_t all = std::accumulate(n_blocks.begin(), n_blocks.end(), std::size_t{0});
  const auto n = static_cast<std::size_t>(n_ranks);
  std::uint32_t row = 0;
  std::size_t passed = 0;
  for (std::size_t r = 0; r < n; ++r) {
    const std::uint32_t begin = row;
    while (row < A.n_rows() && (r + 1 == n || passed * n < (r + 1) * all))
      passed += n_blocks[row++];
    start_.push_back(static_cast<int>(4 * begin));
    count_.push_back(static_cast<int>(4 * (row - begin)));
    if (r == static_cast<std::size_t>(rank)) mine_ = A.rows(begin, row);
  }
}

void SharedProduct::start(const NodalField& x, NodalField& y)
{
  finish();
  if (comm_ == MPI_COMM_NULL) {
    A_.multiply(x, y);
    return;
  }
  y.resize(4, x.cols());
  A_.multiply(x, y, mine_);
  MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, y.data(), count_.data(),
                  start_.data(), MPI_DOUBLE, comm_, &request_);
}

void SharedProduct::finish()
{
  if (request_ != MPI_REQUEST_NULL) MPI_Wait(&request_, MPI_STATUS_IGNORE);
}

} // namespace mergel::fem
