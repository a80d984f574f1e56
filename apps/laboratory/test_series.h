/// Several tests, and what they say together.
#pragma once

#include "apps/laboratory/fits.h"
#include "apps/laboratory/run_groups.h"
#include "apps/laboratory/test_reading.h"

#include <string>
#include <vector>

namespace mergel::apps {

struct TestSeries {
  explicit TestSeries(std::vector<TestReading> read);

  std::vector<TestReading> tests;
  RunGroups groups;
  StrengthFit peak, critical;
  CriticalFit critical_states;
};

/// @param labels one for each folder
/// @throws InputError naming what cannot be read
TestSeries read_series_of_tests(const std::vector<std::string>& folders,
                                const std::vector<std::string>& labels);

} // namespace mergel::apps
