#include "tests/support/catch.h"

#include "apps/view/plot.h"

#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

using namespace mergel::apps;

namespace {

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

std::pair<double, double> ends(Reach reach, const std::vector<double>& values)
{
  const Axis axis = fitting_axis({"", reach}, values);
  return {axis.from, axis.to};
}
using Ends = std::pair<double, double>;

} // namespace

TEST_CASE("An axis includes 0 or covers its values alone, and ends on round numbers",
          "[unit][view]")
{
  CHECK(ends(Reach::from_zero, {3.1, 4.1}) == Ends{0.0, 5.0});
  CHECK(ends(Reach::from_zero, {-1.0, 4.1}) == Ends{-2.0, 6.0});
  const Ends narrow = ends(Reach::of_values, {0.82, NaN, 0.98});
  CHECK(narrow.first == Approx(0.8));
  CHECK(narrow.second == Approx(1.0));
  const Ends constant = ends(Reach::of_values, {0.5, 0.5});
  CHECK((constant.first < 0.5 && constant.second > 0.5 && constant.second < 0.6));
}

TEST_CASE("A logarithmic axis shows three decades at most, and positive values only",
          "[unit][view]")
{
  const auto close = [](const Ends& a, double from, double to) {
    return a.first == Approx(from).epsilon(1e-12) && a.second == Approx(to).epsilon(1e-12);
  };
  CHECK(close(ends(Reach::decades, {-3.0, 0.0, 0.3, 12.0, NaN}), 0.2, 20.0));
  CHECK(close(ends(Reach::decades, {1e-9, 7.0}), 5e-3, 10.0));
  CHECK(close(ends(Reach::decades, {2.0}), 2.0, 20.0));
  CHECK(close(ends(Reach::decades, {-1.0, 0.0}), 0.1, 1.0));
}

TEST_CASE("Equal ratios are equal lengths on a logarithmic axis", "[unit][view]")
{
  const Axis axis{0.1, 10.0, "", true};
  CHECK(axis.at(100.0, 200.0, 0.1) == 100.0);
  CHECK(axis.at(100.0, 200.0, 1.0) == Approx(200.0).epsilon(1e-14));
  CHECK(axis.at(100.0, 200.0, 10.0) == 300.0);
}

TEST_CASE("Ticks have numbers at 1, 2, 5 up to two decades, beyond at powers of ten",
          "[unit][view]")
{
  const auto n_numbers = [](double from, double to) {
    int n = 0;
    for (const double tick : decade_ticks(from, to))
      n += has_number(tick, {from, to, "", true}) ? 1 : 0;
    return n;
  };
  CHECK(decade_ticks(1.0, 10.0).size() == 10);
  CHECK(n_numbers(0.1, 10.0) == 7);
  CHECK(n_numbers(0.005, 5.0) == 3);
  CHECK(n_numbers(0.001, 1000.0) == 7);
}

TEST_CASE("Eight runs have eight colours, 40 have 40 strokes, ten series have ten marks",
          "[unit][view]")
{
  std::set<Colour> colours;
  for (std::size_t k = 0; k < 8; ++k) colours.insert(distinct_stroke(k).colour);
  CHECK(colours.size() == 8);
  std::set<std::pair<Colour, std::vector<double>>> strokes;
  for (std::size_t k = 0; k < 40; ++k)
    strokes.insert({distinct_stroke(k).colour, distinct_stroke(k).dash});
  CHECK(strokes.size() == 40);
  std::set<Mark> marks;
  for (std::size_t k = 0; k < 10; ++k) marks.insert(distinct_mark(k));
  CHECK(marks.size() == 10);
  CHECK(marks.count(Mark::none) == 0);
}
