#include "dem/parallel/rows.h"
#include "dem/parallel/merge_runs.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <random>

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("Any number of sorted runs merges into what a stable sort gives", "[unit][dem]")
{
  struct Record {
    int key, place;
    bool operator==(const Record&) const = default;
  };
  const auto less = [](const Record& a, const Record& b) { return a.key < b.key; };
  std::mt19937_64 random(3);
  for (int n_runs = 0; n_runs < 9; ++n_runs) {
    std::vector<Record> all;
    for (int run = 0; run < n_runs; ++run)
      for (int k = 0, key = 0; k < 5 * run; ++k) {
        key += static_cast<int>(random() % 3);
        all.push_back({key, static_cast<int>(all.size())});
      }
    std::vector<Record> sorted = all;
    std::stable_sort(sorted.begin(), sorted.end(), less);
    merge_runs(all, less);
    CHECK((all == sorted));
  }
}

TEST_CASE("Rows count the owned particles, and a single rank needs nothing from others",
          "[unit][dem]")
{
  Particles p;
  for (int k = 0; k < 4; ++k) p.add(sphere({3.0 * k, 0.0, 0.0}, 1.0));
  CHECK(owned_rows(p) == std::vector<Index>{0, 1, 2, 3});
  const std::vector<double> values{5.0, 6.0, 7.0, 8.0};
  CHECK(gather_rows({}, {}, values, 0) == values);
  CHECK(fetch_rows({}, {}, owned_rows(p), values, {}).empty());
  p.set_ownership({0, 1, 0, 1}, {1, 0, 0, 0});
  CHECK(owned_rows(p) == std::vector<Index>{2, 0, 2, 1});
}
