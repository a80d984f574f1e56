/// Global sums that enter the physics: exact, so that no bit depends on the number of ranks.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/parallel/communicator.h"

#include <vector>

namespace mergel::dem {

/// Exact sums of the ranks, added up by one message: list them, then run().
class ExactReduction {
public:
  bool is_empty() const { return terms_.empty(); }
  template <int exponent>
  void add(ExactSum<exponent>& s)
  {
    terms_.push_back(&s.raw());
  }
  template <class Sum>
  void add(ExactVector<Sum>& v)
  {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  /// Every sum becomes that over all ranks; collective, each rank with the same list.
  void run(const Communicator& comm);

private:
  std::vector<ExactWide*> terms_;
};

} // namespace mergel::dem
