/// Global sums that enter the physics: exact, with the same bits on any number of ranks.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/math/nodal_sums.h"
#include "dem/parallel/communicator.h"

#include <vector>

namespace mergel::dem {

/// Adds a list of exact sums over all ranks by one message: add() each, then run(). Of nodal
/// sums that are shared each rank gets those of its nodes.
class ExactReduction {
public:
  bool is_empty() const { return terms_.empty() && nodal_.empty() && shared_.empty(); }
  /// @param sum an ExactSum, an ExactVector, or a list of these
  template <class Sum>
  void add(Sum& sum)
  {
    visit_raw(sum, [this](ExactWide& raw) { add(raw); });
  }
  void add(ExactWide& raw)
  {
    terms_.push_back(&raw);
    ++n_common_;
  }
  void add(NodalSums& sums)
  {
    (sums.is_shared() ? shared_ : nodal_).push_back(&sums);
    if (!sums.is_shared()) n_common_ += 3 * sums.size();
  }
  /// Replace each sum by that over all ranks; collective, with the same list on all ranks.
  void run(const Communicator& comm);

private:
  bool write_common(std::int64_t limit, std::int64_t* to) const;
  void take_common(const std::int64_t* from);
  bool add_narrow(const Communicator& comm, std::int64_t limit);
  bool share_narrow(const Communicator& comm, std::int64_t limit);
  void add_wide(MPI_Comm comm);

  std::vector<ExactWide*> terms_;
  std::vector<NodalSums*> nodal_, shared_;
  std::size_t n_common_ = 0; ///< numbers of what every rank gets
};

} // namespace mergel::dem
