#include "tests/support/catch.h"

#include "dem/math/nodal_sums.h"

#include <limits>
#include <random>

using namespace mergel::dem;

namespace {

void check_same(const NodalSums& sums, const std::vector<VectorSum>& exact)
{
  REQUIRE(sums.size() == exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k) {
    CHECK(sums.value(k) == exact[k].value());
    const VectorSum sum = sums.sum(k);
    CHECK((sum.x.raw() == exact[k].x.raw() && sum.y.raw() == exact[k].y.raw() &&
           sum.z.raw() == exact[k].z.raw()));
  }
}

} // namespace

TEST_CASE("Nodal sums have the bits of exact sums, whatever the size of their terms",
          "[unit][dem]")
{
  const double decade = GENERATE(-6.0, 0.0, 1.0, 9.0); // 2 N is the largest term of 64 bits
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0), below(decade - 6.0, decade);
  NodalSums sums(4);
  std::vector<VectorSum> exact(4);
  for (int n = 0; n < 4000; ++n) {
    const double size = std::pow(10.0, below(random));
    const Vec3 f = size * Vec3(u(random), u(random), u(random));
    const std::size_t node = static_cast<std::size_t>(n) % 3; // the fourth gets none
    sums.add(node, Row{f.x(), f.y(), f.z(), 0.0});
    exact[node].add(f);
  }
  check_same(sums, exact);
}

TEST_CASE("Many large terms at one node do not overflow 64 bits", "[unit][dem]")
{
  NodalSums sums(2);
  std::vector<VectorSum> exact(2);
  for (int n = 0; n < 3 * most_lane_terms; ++n) { // 12 kN; 64 bits end at 8 kN
    sums.add(1, Row{1.99, -1.99, 0.5, 0.0});
    exact[1].add({1.99, -1.99, 0.5});
  }
  check_same(sums, exact);
}

TEST_CASE("A force of some newtons leaves the sums in 64 bits, some kilonewtons do not",
          "[unit][dem]")
{
  constexpr std::int64_t limit = std::int64_t{1} << 61;
  NodalSums sums(1);
  for (int n = 0; n < 100; ++n) sums.add(0, Row{15.0, -3.0, 0.0, 0.0});
  CHECK(sums.are_narrow({0, 1}, limit));
  CHECK(sums.value(0) == Vec3(1500.0, -300.0, 0.0));
  sums.add(0, Row{1000.0, 0.0, 0.0, 0.0});
  CHECK_FALSE(sums.are_narrow({0, 1}, limit));
  CHECK(sums.value(0) == Vec3(2500.0, -300.0, 0.0));
}

TEST_CASE("A nodal force that is not a number is refused", "[unit][dem]")
{
  NodalSums sums(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(sums.add(0, Row{0.0, nan, 0.0, 0.0}), mergel::NumericalError);
  CHECK_THROWS_AS(sums.add(0, Row{0.0, 0.0, 1e16, 0.0}), mergel::NumericalError);
}

TEST_CASE("Sums that leave no room for those of the other ranks do not go as 64 bits",
          "[unit][dem]")
{
  NodalSums sums(3);
  sums.add(2, Row{1.0, -1.5, 0.25, 0.0});
  const auto quanta = static_cast<std::int64_t>(1.5 * ForceSum::scale);
  std::vector<std::int64_t> values(10, 7);
  const auto write = [&](const NodeRange& nodes, std::int64_t limit) {
    std::int64_t* next = values.data() + 1;
    const bool has_room = sums.write_narrow(nodes, limit, next);
    CHECK(next == values.data() + 1 + 3 * (nodes.end - nodes.first));
    return has_room;
  };
  CHECK_FALSE(write({0, 3}, quanta));
  CHECK(write({0, 2}, quanta)); // the large one is elsewhere
  CHECK_FALSE(sums.are_narrow({2, 3}, quanta));
  REQUIRE(write({0, 3}, quanta + 1));
  CHECK(values.front() == 7);
  NodalSums taken(3);
  CHECK(taken.take_narrow(values.data() + 1) == values.data() + 10);
  CHECK(taken.value(2) == Vec3(1.0, -1.5, 0.25));
  CHECK(taken.value(0) == Vec3(0.0, 0.0, 0.0));
  sums.add(0, Row{1e5, 0.0, 0.0, 0.0}); // a wide sum
  CHECK_FALSE(write({1, 2}, std::int64_t{1} << 61));
  sums.clear();
  CHECK(sums.value(0) == Vec3(0.0, 0.0, 0.0));
}

TEST_CASE("Of shared sums a rank adds those of others at its own nodes only", "[unit][dem]")
{
  NodalSums sums(4);
  CHECK_FALSE(sums.is_shared());
  CHECK(sums.own().end == 4);
  sums.share({{0, 1, 3, 4}, 1});
  REQUIRE(sums.is_shared());
  CHECK(sums.own().first == 1);
  CHECK(sums.own().end == 3);
  CHECK(sums.nodes_of(2).first == 3);
  for (std::size_t k = 0; k < 4; ++k) sums.add(k, Row{1.0, 0.0, 0.0, 0.0});
  const auto one = static_cast<std::int64_t>(ForceSum::scale);
  const std::vector<std::int64_t> others{one, 2 * one, 0, 0, 0, -one};
  CHECK(sums.add_narrow(others.data()) == others.data() + others.size());
  CHECK(sums.value(0) == Vec3(1.0, 0.0, 0.0));
  CHECK(sums.value(1) == Vec3(2.0, 2.0, 0.0));
  CHECK(sums.value(2) == Vec3(1.0, 0.0, -1.0));
  CHECK(sums.value(3) == Vec3(1.0, 0.0, 0.0));
  ExactWide part = 0; // the parts of all ranks are the total
  visit_part(sums, [&](const ExactWide& raw) { part += raw; });
  CHECK((part == ExactWide{one} * 4));
}
