/// Panels below each other or side by side, each with a line of words above it, and a key
/// over all: no word lies on the data.
#pragma once

#include "apps/laboratory/test_series.h"
#include "apps/view/curve.h"
#include "apps/view/page.h"

#include <string>
#include <vector>

namespace mergel::apps {

struct Layout {
  std::vector<Box> boxes; ///< row by row
  Box key;
};
Layout captioned_panels(const Page& page, std::size_t n_rows, std::size_t n_columns,
                        const std::vector<KeyEntry>& entries);

/// Above the box, from its left edge.
void write_caption(Page& page, const Box& box, const std::string& words);

/// "+-", minus and R2 as the signs they stand for; phi, which the font lacks, in words.
std::string typeset(std::string words);

/// The name of each group of tests: that of its only test, or "1 MPa, 3 realisations".
std::vector<std::string> group_names(const TestSeries& series);

/// The group of each test, from 0: the number of its stroke.
std::vector<std::size_t> group_of_each(const TestSeries& series);

} // namespace mergel::apps
