// Tables of a checkpoint: columns by their names.
#include "tests/support/catch.h"

#include "dem/io/state/named_rows.h"

using namespace mergel;
using namespace mergel::dem;
using mergel::match::Contains;

namespace {

struct Row {
  double p = 0.0, q = 0.0;
  std::size_t n = 0;
  bool is_last = false;

  bool operator==(const Row&) const = default;
};

const auto numbers_of = [](auto& r) {
  return NumbersOf<std::remove_reference_t<decltype(r)>>{{"p [Pa]", &r.p},
                                                         {"q [Pa]", &r.q}};
};
const auto counts_of = [](auto& r) {
  return CountsOf<std::remove_reference_t<decltype(r)>>{{"steps", &r.n},
                                                        {"is last", &r.is_last}};
};

State saved(const std::vector<Row>& rows)
{
  State state;
  save_number_rows(state, "numbers", rows, numbers_of);
  save_count_rows(state, "counts", rows, counts_of);
  return state;
}

std::vector<Row> loaded(const State& state)
{
  std::vector<Row> rows = load_count_rows<Row>(state, "counts", counts_of);
  load_number_rows(state, "numbers", rows, numbers_of);
  return rows;
}

const std::vector<Row> rows{{1.0, 2.0, 3, false}, {4.0, 5.0, 6, true}};

} // namespace

TEST_CASE("Rows are loaded as they were saved, by the names of their columns",
          "[unit][dem]")
{
  State state = saved(rows);
  CHECK(loaded(state) == rows);
  CHECK(loaded(saved({})).empty());
  CHECK(state.text("numbers_names") == "p [Pa]\nq [Pa]\n");

  // The order of the columns does not matter.
  state.add<double>("numbers", {2.0, 1.0, 5.0, 4.0}, 2);
  state.add_text("numbers_names", "q [Pa]\np [Pa]\n");
  CHECK(loaded(state) == rows);
}

TEST_CASE("A table whose columns are not those of the program is refused by their names",
          "[unit][dem]")
{
  State state = saved(rows);
  state.add_text("numbers_names", "p [Pa]\nr [Pa]\n");
  CHECK_THROWS_WITH(loaded(state), Contains("numbers") && Contains("no column `q [Pa]`"));
  state.add_text("numbers_names", "p [Pa]\nq [Pa]\nr [Pa]\n");
  CHECK_THROWS_WITH(loaded(state), Contains("the column `r [Pa]`, which"));
  state.add_text("numbers_names", "p [Pa]\nq [Pa]\nq [Pa]\n");
  CHECK_THROWS_WITH(loaded(state), Contains("the column `q [Pa]` twice"));
  state = saved(rows);
  state.add<double>("numbers", {1.0, 2.0}, 2);
  CHECK_THROWS_WITH(loaded(state), Contains("has 1 rows, not 2"));
  state = saved(rows);
  state.add<std::uint64_t>("counts", {3, 0, 6, 2}, 2);
  CHECK_THROWS_WITH(loaded(state), Contains("has 2 for `is last`, at most 1"));
}
