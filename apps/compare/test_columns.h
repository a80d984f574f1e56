/// The readings of a test that tables of several show, each a column.
#pragma once

#include "apps/laboratory/test_reading.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mergel::apps {

struct TestColumn {
  const char *name, *unit;       ///< in files: "Young's modulus", "Pa"
  const char *head, *shown_unit; ///< on the terminal: "E", "GPa"; not there: no head
  double shown_size;             ///< of that unit [SI]
  double (*of)(const TestReading&);

  std::string heading() const { return std::string(name) + " [" + unit + "]"; }
};

const std::vector<TestColumn>& test_columns();

/// Of these tests.
std::vector<double> values_of(const TestColumn& column,
                              const std::vector<TestReading>& tests,
                              const std::vector<std::size_t>& members);

} // namespace mergel::apps
