
#include "tests/support/catch.h"

#include <cstdint>
#include <vector>

namespace {

// One function per pattern: the compiler error is in the store of a braced list.
[[gnu::noinline]] std::vector<std::uint64_t> three_ones_and_none()
{
  return {1, 1, 1, 0};
}
[[gnu::noinline]] std::vector<double> thrice_and_none(double a)
{
  return {a, a, a, 0.0};
}
[[gnu::noinline]] std::vector<double> four_times_and_none(double a)
{
  return {a, a, a, a, 0.0, 0.0, 0.0, 0.0};
}

} // namespace

// GCC 12.2 with -O3 and AVX-512 sets all elements to the first number; see CMakeLists.txt.
TEST_CASE("The compiler keeps the zeros after equal numbers", "[unit][dem]")
{
  CHECK(three_ones_and_none() == std::vector<std::uint64_t>{1, 1, 1, 0});
  const std::vector<double> three = thrice_and_none(3.0), four = four_times_and_none(5.0);
  CHECK(three[2] == 3.0);
  CHECK(three[3] == 0.0);
  CHECK(four[3] == 5.0);
  for (std::size_t k = 4; k < 8; ++k) CHECK(four[k] == 0.0);
}
