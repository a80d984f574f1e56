/// Runs that differ only by seed: realisations of one test.
#pragma once

#include "apps/laboratory/test_reading.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mergel::apps {

struct RunGroups {
  /// Numbers of the tests of each group, in the order of the first of each.
  std::vector<std::vector<std::size_t>> members;
  /// On runs that have the seed of another too, which are no further realisations; each has
  /// a group of its own.
  std::vector<std::string> notes;
};

RunGroups group_by_seed(const std::vector<TestReading>& tests);

struct Mean {
  double mean = no_value;
  double error = no_value; ///< standard error s/sqrt(n); NaN for n = 1
  std::size_t n = 0;       ///< values that are not NaN
};
Mean mean_with_error(const std::vector<double>& values);

/// "1 MPa" of a triaxial test, "unconfined", "isotropic", ... : what distinguishes groups.
std::string condition_of(const TestReading& test);

} // namespace mergel::apps
