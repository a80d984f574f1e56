/// The ranks that an assembly is distributed over, and their global operations.
#pragma once

#include "dem/collective_failure.h"

#include <cstddef>
#include <functional>
#include <mpi.h>
#include <vector>

namespace mergel::dem {

class Communicator {
public:
  /// One rank that owns everything; MPI need not be initialised.
  Communicator() = default;
  /// @param comm must outlive the communicator
  explicit Communicator(MPI_Comm comm);

  int rank() const { return rank_; }
  int n_ranks() const { return n_ranks_; }
  bool is_alone() const { return n_ranks_ == 1; }
  /// MPI_COMM_NULL for one rank without MPI.
  MPI_Comm mpi() const { return comm_; }

  double global_min(double value) const;              ///< collective
  double global_max(double value) const;              ///< collective
  void global_max(std::vector<double>& values) const; ///< of each; collective
  std::size_t global_sum(std::size_t count) const;    ///< collective
  /// Number of reductions since the start: sums, minima, maxima and faults.
  std::size_t n_reductions() const { return n_reductions_; }

  /// Throw on all ranks when one of them has a fault; collective.
  /// @throws Unstable on all ranks, with the message of the lowest rank that found one
  void agree_on(const Fault& fault) const;

  /// Records of all ranks on every rank, in the order of the ranks; collective.
  template <class Record>
  std::vector<Record> gather(const std::vector<Record>& mine) const
  {
    if (is_alone()) return mine;
    std::vector<Record> all;
    gather_bytes(mine.data(), mine.size(), sizeof(Record), [&all](std::size_t n) {
      all.resize(n);
      return static_cast<void*>(all.data());
    });
    return all;
  }

  /// The same on the rank `to`, nothing on the others; collective.
  template <class Record>
  std::vector<Record> gather_on(int to, const std::vector<Record>& mine) const
  {
    if (is_alone()) return mine;
    std::vector<int> counts(static_cast<std::size_t>(n_ranks_), 0);
    counts[static_cast<std::size_t>(to)] = static_cast<int>(mine.size());
    std::vector<Record> all;
    exchange_bytes(mine.data(), counts, sizeof(Record), [&all](std::size_t n) {
      all.resize(n);
      return static_cast<void*>(all.data());
    });
    return all;
  }

  /// What all ranks have for this one, in the order of the ranks; collective.
  /// @param to for each rank the records that it shall get
  template <class Record>
  std::vector<Record> exchange(const std::vector<std::vector<Record>>& to) const
  {
    std::vector<Record> mine, received;
    std::vector<int> counts;
    for (const std::vector<Record>& records : to) {
      mine.insert(mine.end(), records.begin(), records.end());
      counts.push_back(static_cast<int>(records.size()));
    }
    if (is_alone()) return mine;
    exchange_bytes(mine.data(), counts, sizeof(Record), [&received](std::size_t n) {
      received.resize(n);
      return static_cast<void*>(received.data());
    });
    return received;
  }

private:
  friend class ExactReduction;
  void exchange_bytes(const void* mine, const std::vector<int>& counts, std::size_t size,
                      const std::function<void*(std::size_t)>& allocate) const;
  void gather_bytes(const void* mine, std::size_t n, std::size_t size,
                    const std::function<void*(std::size_t)>& allocate) const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, n_ranks_ = 1;
  mutable std::size_t n_reductions_ = 0;
};

} // namespace mergel::dem
