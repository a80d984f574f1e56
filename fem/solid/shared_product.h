/// Product with a matrix that every rank holds; its rows are distributed over the ranks.
#pragma once

#include "fem/solid/block_matrix.h"

#include <mpi.h>

namespace mergel::fem {

/// y = A x on every rank; each rank computes an even share of the blocks. No bit depends on
/// the number of ranks. The matrix is borrowed and must outlive the object.
class SharedProduct {
public:
  /// @param comm must outlive the object; MPI_COMM_NULL: one rank, without MPI
  SharedProduct(const BlockMatrix& A, MPI_Comm comm);

  SharedProduct(const SharedProduct&) = delete;
  SharedProduct& operator=(const SharedProduct&) = delete;
  ~SharedProduct() { finish(); }

  /// Collective; x the same on all ranks.
  void multiply(const NodalField& x, NodalField& y)
  {
    start(x, y);
    finish();
  }

  /// Compute the rows of this rank and send them, while the ranks do something else; y is
  /// complete after finish(). Both are collective. y must stay where it is until then.
  void start(const NodalField& x, NodalField& y);
  void finish();

private:
  const BlockMatrix& A_;
  MPI_Comm comm_;
  BlockMatrix::Rows mine_;
  std::vector<int> count_, start_; // of doubles of y, by rank
  MPI_Request request_ = MPI_REQUEST_NULL;
};

} // namespace mergel::fem
