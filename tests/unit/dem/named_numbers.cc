// Numbers and counts of a checkpoint by their names.
#include "dem/io/state/named_numbers.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <cmath>

using namespace mergel;
using namespace mergel::dem;

namespace {

enum class Colour { red, green, blue };

struct Numbers {
  double dt = 0.0, time = 0.0;
  std::size_t n = 0;
  bool is_done = false;
  Colour colour = Colour::red;
};

template <class Self>
NumbersOf<Self> numbers_of(Self& s)
{
  return {{"time step [s]", &s.dt}, {"time [s]", &s.time}};
}

template <class Self>
CountsOf<Self> counts_of(Self& s)
{
  return {
      {"steps [-]", &s.n}, {"is done", &s.is_done}, {"colour", &s.colour, Colour::blue}};
}

State saved(const Numbers& n)
{
  State state;
  save_numbers(state, "numbers", numbers_of(n));
  save_counts(state, "counts", counts_of(n));
  return state;
}

Numbers loaded(const State& state)
{
  Numbers n;
  load_numbers(state, "numbers", numbers_of(n));
  load_counts(state, "counts", counts_of(n));
  return n;
}

std::string refusal(const State& state)
{
  try {
    loaded(state);
  } catch (const InputError& e) {
    return e.what();
  }
  return "loaded";
}

const std::string refused = "does not fit this program or case: its array ";

} // namespace

TEST_CASE("numbers and counts of a state come back by name, through a file", "[unit][dem]")
{
  const TemporaryFolder folder;
  const auto file = folder.path / "numbers.h5";
  write_state(file, "test", 1,
              saved({1e-7 / 3.0, -0.0, ~std::size_t{0}, true, Colour::blue}),
              Communicator());
  const Numbers n = loaded(read_state(file, "test", 1));
  CHECK(n.dt == 1e-7 / 3.0);
  CHECK(std::signbit(n.time));
  CHECK(n.n == ~std::size_t{0});
  CHECK(n.is_done);
  CHECK(n.colour == Colour::blue);
}

TEST_CASE("numbers are found by name in any order", "[unit][dem]")
{
  State state = saved({});
  state.add<double>("numbers", {2.0, 1.0});
  state.add_text("numbers_names", "time [s]\ntime step [s]\n");
  CHECK(loaded(state).dt == 1.0);
  CHECK(loaded(state).time == 2.0);
}

TEST_CASE("a missing, unknown or double number is refused by its name", "[unit][dem]")
{
  State state = saved({});
  const auto numbers = [&](std::vector<double> values, const std::string& names) {
    state.add("numbers", std::move(values));
    state.add_text("numbers_names", names);
    return refusal(state);
  };
  CHECK(numbers({1.0}, "time [s]\n") == refused + "numbers has no number `time step [s]`");
  CHECK(numbers({1.0, 2.0, 3.0}, "time [s]\ntime step [s]\ntemperature [K]\n") ==
        refused +
            "numbers has the number `temperature [K]`, which this program does not know");
  CHECK(numbers({1.0, 2.0, 3.0}, "time [s]\ntime step [s]\ntime [s]\n") ==
        refused + "numbers has the number `time [s]` twice");
  CHECK(numbers({1.0, 2.0}, "time [s]\n") == refused + "numbers has 2 numbers and 1 names");
  state.forget("numbers_names");
  CHECK(refusal(state) == refused + "numbers_names is missing");
}

TEST_CASE("a flag or choice out of its range is refused by its name", "[unit][dem]")
{
  State state = saved({});
  state.add<std::uint64_t>("counts", {5, 2, 0});
  CHECK(refusal(state) == refused + "counts has 2 for `is done`, at most 1");
  state.add<std::uint64_t>("counts", {5, 1, 3});
  CHECK(refusal(state) == refused + "counts has 3 for `colour`, at most 2");
  state.add<std::uint64_t>("counts", {5, 1, 2});
  CHECK(refusal(state) == "loaded");
}

TEST_CASE("two numbers of one name cannot be saved", "[unit][dem]")
{
  State state;
  double a = 1.0, b = 2.0;
  CHECK_THROWS_AS(save_numbers(state, "numbers",
                               std::vector<NamedNumber<double>>{{"a", &a}, {"a", &b}}),
                  std::logic_error);
  CHECK_THROWS_AS(
      save_numbers(state, "numbers", std::vector<NamedNumber<double>>{{"a\n", &a}}),
      std::logic_error);
}
