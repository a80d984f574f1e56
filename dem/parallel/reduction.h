/// Global sums that enter the physics: exact, with the same bits on any number of ranks.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/math/nodal_sums.h"
#include "dem/parallel/communicator.h"

#include <vector>

namespace mergel::dem {

/// Adds a list of exact sums over all ranks by one reduction: add() each, then run().
class ExactReduction {
public:
  bool is_empty() const { return terms_.empty() && nodal_.empty(); }
  /// @param sum an ExactSum, an ExactVector, or a list of these
  template <class Sum>
  void add(Sum& sum)
  {
    visit_raw(sum, [this](ExactWide& raw) { terms_.push_back(&raw); });
  }
  void add(ExactWide& raw) { terms_.push_back(&raw); }
  void add(NodalSums& sums) { nodal_.push_back(&sums); }
  /// Replace each sum by that over all ranks; collective, with the same list on all ranks.
  void run(const Communicator& comm);

private:
  bool add_narrow(int n_ranks, MPI_Comm comm);
  void add_wide(MPI_Comm comm);

  std::vector<ExactWide*> terms_;
  std::vector<NodalSums*> nodal_;
};

} // namespace mergel::dem
