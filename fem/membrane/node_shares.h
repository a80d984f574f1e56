/// The nodes of a mesh shared among the ranks: a block of consecutive nodes each.
#pragma once

#include "fem/nodal.h"

#include <mpi.h>

namespace mergel::fem {

class NodeShares {
public:
  /// @param comm MPI_COMM_NULL: one rank, without MPI
  NodeShares(Eigen::Index n_nodes, MPI_Comm comm) : comm_(comm)
  {
    int rank = 0, n_ranks = 1;
    if (comm_ != MPI_COMM_NULL) {
      MPI_Comm_rank(comm_, &rank);
      MPI_Comm_size(comm_, &n_ranks);
    }
    rank_ = static_cast<std::size_t>(rank);
    for (Eigen::Index r = 0; r <= n_ranks; ++r) first_.push_back(n_nodes * r / n_ranks);
  }

  bool is_alone() const { return first_.size() == 2; }
  std::size_t rank() const { return rank_; }
  /// Of each rank its first node, and at the end the number of nodes.
  const std::vector<Eigen::Index>& first_of_rank() const { return first_; }
  Eigen::Index first() const { return first_[rank_]; } ///< node of this rank
  Eigen::Index end() const { return first_[rank_ + 1]; }
  bool has(Eigen::Index node) const { return node >= first() && node < end(); }

  /// Complete a field of which each rank has the columns of its nodes; collective.
  template <class Field>
  void gather(Field& field) const
  {
    if (is_alone()) return;
    constexpr int n_rows = Field::RowsAtCompileTime;
    std::vector<int> count, start;
    for (std::size_t r = 0; r + 1 < first_.size(); ++r) {
      start.push_back(static_cast<int>(n_rows * first_[r]));
      count.push_back(static_cast<int>(n_rows * (first_[r + 1] - first_[r])));
    }
    MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, field.data(), count.data(),
                   start.data(), MPI_DOUBLE, comm_);
  }
  /// A field as gather() completes it.
  template <class Field>
  Field gathered(Field field) const
  {
    gather(field);
    return field;
  }

private:
  MPI_Comm comm_;
  std::size_t rank_;
  std::vector<Eigen::Index> first_;
};

} // namespace mergel::fem
