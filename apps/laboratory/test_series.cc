#include "apps/laboratory/test_series.h"

#include <utility>

namespace mergel::apps {

TestSeries::TestSeries(std::vector<TestReading> read)
    : tests(std::move(read)), groups(group_by_seed(tests)), peak(peak_strength(tests)),
      critical(critical_strength(tests)), critical_states(critical_states_of(tests))
{
}

TestSeries read_series_of_tests(const std::vector<std::string>& folders,
                                const std::vector<std::string>& labels)
{
  std::vector<TestReading> tests;
  for (std::size_t k = 0; k < folders.size(); ++k)
    tests.push_back(read_test(folders[k], labels[k]));
  return TestSeries(std::move(tests));
}

} // namespace mergel::apps
