#include "tests/support/catch.h"

#include "dem/math/lane_sum.h"

#include <algorithm>
#include <limits>
#include <random>

using namespace mergel::dem;

TEST_CASE("Any order of the terms gives the same bits", "[unit][dem]")
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0), decade(-12.0, 3.0);
  std::vector<double> terms(5000);
  for (double& a : terms) a = u(random) * std::pow(10.0, decade(random));

  const auto sum = [&] {
    ForceSum s;
    for (const double a : terms) s.add(a);
    return s.value();
  };
  const double first = sum();
  double plain = 0.0;
  for (const double a : terms) plain += a;
  CHECK(first == Approx(plain).epsilon(1e-12));
  for (int shuffle = 0; shuffle < 20; ++shuffle) {
    std::shuffle(terms.begin(), terms.end(), random);
    REQUIRE(sum() == first);
  }
  // and as the sum of two partial sums
  ForceSum low, high;
  for (std::size_t k = 0; k < terms.size(); ++k) (k % 3 == 0 ? low : high).add(terms[k]);
  low += high;
  CHECK(low.value() == first);
}

TEST_CASE("A sum is exact to its quantum and returns to zero", "[unit][dem]")
{
  ForceSum s;
  for (int k = 0; k < 10000; ++k) s.add(4000.0); // far beyond 64 bits of quanta
  CHECK(s.value() == 4e7);
  for (int k = 0; k < 10000; ++k) s.add(-4000.0);
  CHECK(s.value() == 0.0);
  s.add(1e9); // more quanta than 64 bits hold
  s.add(0.1);
  s.add(-1e9);
  CHECK(std::abs(s.value() - 0.1) <= 0x1p-51);
  s.clear();
  CHECK(s.value() == 0.0);
}

TEST_CASE("A term out of range or undefined throws instead of being clipped", "[unit][dem]")
{
  ForceSum s;
  CHECK_NOTHROW(s.add(0x1.fffffffffffffp49));
  CHECK_THROWS_AS(s.add(0x1p50), mergel::NumericalError);
  CHECK_THROWS_AS(s.add(-0x1p50), mergel::NumericalError);
  CHECK_THROWS_AS(s.add(std::numeric_limits<double>::quiet_NaN()), mergel::NumericalError);
  CHECK_THROWS_AS(s.add(std::numeric_limits<double>::infinity()), mergel::NumericalError);
  CHECK(s.value() == 0x1.fffffffffffffp49); // the refused terms were not added

  EnergySum e;
  CHECK_NOTHROW(e.add(-5e11));
  CHECK_THROWS_AS(e.add(0x1p39), mergel::NumericalError);
  VectorSum v;
  CHECK_THROWS_AS(v.add({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}),
                  mergel::NumericalError);
}

namespace {

/// Adds the terms in lanes of V, and one by one; true when both sums have the same bits.
template <class V>
bool are_lanes_alike(const std::vector<double>& terms)
{
  EnergySum in_lanes, one_by_one;
  {
    LaneEnergySum<V> sum(in_lanes);
    constexpr std::size_t n = n_lanes_of<V>;
    for (std::size_t k = 0; k < terms.size(); k += n) {
      V some{};
      for (std::size_t l = 0; l < n && k + l < terms.size(); ++l)
        some[static_cast<int>(l)] = terms[k + l];
      sum.add(some);
    }
  }
  for (const double a : terms) one_by_one.add(a);
  return in_lanes.raw() == one_by_one.raw();
}

} // namespace

TEST_CASE("Lanes give the bits of terms that are added one by one", "[unit][dem]")
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  // From ties of the rounding, halves of a quantum, to terms of more than 64 bits.
  for (const double size : {0x1p-60, 0x1p-50, 0x1p-12, 0x1p-10, 1.0, 1e6}) {
    std::vector<double> terms(40003); // more than are kept in 64 bits; not a whole batch
    for (double& a : terms)
      a = size > 0x1p-60 ? size * u(random) : std::round(8.0 * u(random)) * 0x1p-62;
    CAPTURE(size);
    CHECK(are_lanes_alike<Lanes>(terms));
    CHECK(are_lanes_alike<TwoRows>(terms));
    CHECK(are_lanes_alike<Row>(terms));
  }
  // The largest terms that are added as integers, all of one sign: no overflow.
  CHECK(are_lanes_alike<Lanes>(std::vector<double>(100000, 0x1.fffffffffffffp-11)));
  EnergySum s;
  LaneEnergySum<Lanes> lanes(s);
  CHECK_THROWS_AS(lanes.add(Lanes{} + std::numeric_limits<double>::quiet_NaN()),
                  mergel::NumericalError);
  CHECK_THROWS_AS(lanes.add(Lanes{} + 0x1p39), mergel::NumericalError);
}
