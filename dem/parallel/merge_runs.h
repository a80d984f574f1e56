/// Records of all ranks in one order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mergel::dem {

/// Sort what consists of a few sorted runs, such as records gathered from ranks that have them in
/// order; equal ones keep their order. Linear for one run.
template <class Record, class Less>
void merge_runs(std::vector<Record>& all, Less less)
{
  std::vector<std::ptrdiff_t> ends; // of the runs
  for (std::size_t k = 1; k < all.size(); ++k)
    if (less(all[k], all[k - 1])) ends.push_back(static_cast<std::ptrdiff_t>(k));
  ends.push_back(static_cast<std::ptrdiff_t>(all.size()));
  while (ends.size() > 1) {
    std::vector<std::ptrdiff_t> merged;
    std::ptrdiff_t begin = 0;
    for (std::size_t r = 0; r < ends.size(); r += 2) {
      const std::ptrdiff_t middle = ends[r], end = ends[std::min(r + 1, ends.size() - 1)];
      std::inplace_merge(all.begin() + begin, all.begin() + middle, all.begin() + end,
                         less);
      merged.push_back(end);
      begin = end;
    }
    ends = merged;
  }
}

} // namespace mergel::dem
