#include "apps/laboratory/run_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

RunGroups group_by_seed(const std::vector<TestReading>& tests)
{
  RunGroups groups;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const TestCase& mine = tests[k].test_case;
    bool is_placed = false;
    for (auto& group : groups.members) {
      if (tests[group.front()].test_case.other_keys != mine.other_keys) continue;
      const auto twin = std::find_if(group.begin(), group.end(), [&](std::size_t other) {
        return tests[other].test_case.seeds == mine.seeds;
      });
      if (twin == group.end()) {
        group.push_back(k);
        is_placed = true;
      } else {
        groups.notes.push_back(tests[k].label + " has the case and the seed of " +
                               tests[*twin].label + ": it is no further realisation");
      }
      break;
    }
    if (!is_placed) groups.members.push_back({k});
  }
  return groups;
}

Mean mean_with_error(const std::vector<double>& values)
{
  Mean m;
  double sum = 0.0, squares = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) {
      sum += value;
      ++m.n;
    }
  if (m.n == 0) return m;
  const auto n = static_cast<double>(m.n);
  m.mean = sum / n;
  for (const double value : values)
    if (std::isfinite(value)) squares += (value - m.mean) * (value - m.mean);
  if (m.n > 1) m.error = std::sqrt(squares / (n - 1.0) / n);
  return m;
}

std::string condition_of(const TestReading& test)
{
  if (test.kind != TestKind::triaxial) return name_of(test.kind);
  char text[40];
  std::snprintf(text, sizeof text, "%.2g MPa", 1e-6 * test.confinement);
  return text;
}

} // namespace mergel::apps
