/// Several tests in one table: on the terminal, as tests.csv and as tests.json.
#pragma once

#include "apps/laboratory/test_series.h"

#include <iosfwd>
#include <string>

namespace mergel::apps {

/// A row for each test, the mean and its standard error for each group of several, and the
/// lines through them, or why there are none. Stresses in MPa.
void print(std::ostream& out, const TestSeries& series);

/// A line for each test, then for each group of several its mean and its standard error; an
/// empty cell where a test has no value. SI units, in the headings.
std::string csv_of(const TestSeries& series);

/// All of it; what does not exist has no member.
/// @param made_by a JSON object (apps/run/provenance.h)
std::string json_of(const TestSeries& series, const std::string& made_by);

} // namespace mergel::apps
