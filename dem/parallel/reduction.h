/// Global sums that enter the physics: exact, with the same bits on any number of ranks.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/parallel/communicator.h"

#include <vector>

namespace mergel::dem {

/// Adds a list of exact sums over all ranks by one reduction: add() each, then run().
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
  /// Replace each sum by that over all ranks; collective, with the same list on all ranks.
  void run(const Communicator& comm);

private:
  std::vector<ExactWide*> terms_;
};

} // namespace mergel::dem
