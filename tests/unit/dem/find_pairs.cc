#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/pairs/neighbours.h"

#include <algorithm>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// n particles in a box of edges `size`; diameters over a decade, uniform in the logarithm.
Particles cloud(int n, const Vec3& size, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Particles p;
  for (int k = 0; k < n; ++k) {
    const Vec3 x = 0.5 * (random_vector(random) + Vec3::Ones()).cwiseProduct(size);
    ParticleState b = sphere(x, 0.005 * std::pow(10.0, u(random)));
    b.S = 1.0 + u(random);
    p.add(b);
  }
  return p;
}

/// All pairs, all images within n_images cells.
std::vector<Pair> by_force(const Particles& p, const PeriodicCell& cell, double range,
                           int n_images)
{
  const auto images = [&](int a) { return cell.size[a] > 0.0 ? n_images : 0; };
  std::vector<Pair> found;
  for (Index i = 0; i < p.size(); ++i)
    for (Index j = i + 1; j < p.size(); ++j)
      for (int a = -images(0); a <= images(0); ++a)
        for (int b = -images(1); b <= images(1); ++b)
          for (int c = -images(2); c <= images(2); ++c) {
            const Shift s{static_cast<std::int16_t>(a), static_cast<std::int16_t>(b),
                          static_cast<std::int16_t>(c)};
            const ParticleState &bi = p.state[i], &bj = p.state[j];
            const double gap = (bj.x + cell.offset(s) - bi.x).norm() - bi.R - bj.R;
            if (gap < range * 0.5 * (bi.S + bj.S)) found.push_back({i, j, s});
          }
  return found; // ascending by construction
}

} // namespace

TEST_CASE("The cell search finds the pairs of a brute-force search, in ascending order",
          "[unit][dem]")
{
  const Particles p = cloud(1200, {0.6, 0.5, 0.4}, 1);
  for (const double range : {0.0, 0.002, 0.02}) {
    const auto found = find_pairs(p, {}, range);
    CHECK(found == by_force(p, {}, range, 0));
    CHECK(std::is_sorted(found.begin(), found.end()));
    CHECK(found.size() > 200);
  }
}

TEST_CASE("Pairs at other positions are those of particles that are there", "[unit][dem]")
{
  const Particles there = cloud(600, {0.5, 0.4, 0.3}, 1);
  std::vector<Vec3> x;
  Particles elsewhere = there;
  for (ParticleState& b : elsewhere.state) {
    x.push_back(b.x);
    b.x = -3.0 * b.x;
  }
  std::vector<char> is_owned(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i) is_owned[i] = x[i].x() < 0.1;
  Particles part = there;
  for (Particles* p : {&part, &elsewhere})
    p->set_ownership(is_owned, std::vector<char>(x.size(), 0));
  const auto found = find_pairs(part, {}, 0.01);
  CHECK(found.size() > 20);
  CHECK(find_pairs(elsewhere, {}, 0.01, {}, x) == found);
}

TEST_CASE("The search finds images across the periodic boundaries", "[unit][dem]")
{
  const auto size =
      GENERATE(Vec3(0.41, 0.41, 0.41), Vec3(0.45, 0.0, 0.0), Vec3(0.0, 0.42, 0.6));
  const PeriodicCell cell{size};
  const Particles p = cloud(500, {0.41, 0.42, 0.43}, 2);
  const auto found = find_pairs(p, cell, 0.003);
  CHECK(found == by_force(p, cell, 0.003, 1));
  CHECK(std::any_of(found.begin(), found.end(),
                    [](const Pair& q) { return q.shift != Shift{}; }));
}

TEST_CASE("Positions moved by many cells give the same pairs, with shifts to match",
          "[unit][dem]")
{
  const PeriodicCell cell{{0.5, 0.5, 0.5}};
  Particles p = cloud(300, cell.size, 3);
  const auto home = find_pairs(p, cell, 0.003);
  std::mt19937_64 random(4);
  std::vector<Shift> moved(p.size());
  for (Index i = 0; i < p.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      moved[i][a] = static_cast<std::int16_t>(static_cast<int>(random() % 2001) - 1000);
      p.state[i].x[static_cast<int>(a)] += 0.5 * moved[i][a];
    }
  const auto away = find_pairs(p, cell, 0.003);
  REQUIRE(away.size() == home.size());
  for (std::size_t k = 0; k < home.size(); ++k) {
    REQUIRE((away[k].i == home[k].i && away[k].j == home[k].j));
    for (std::size_t a = 0; a < 3; ++a) // x_j + offset(shift) is the same neighbour
      REQUIRE(away[k].shift[a] ==
              home[k].shift[a] + moved[home[k].i][a] - moved[home[k].j][a]);
  }
}

TEST_CASE("A cell in which a particle could touch its own image is refused", "[unit][dem]")
{
  Particles p;
  p.add(sphere({0, 0, 0}, 1.0));
  CHECK_NOTHROW(find_pairs(p, {{4.0, 0.0, 0.0}}, 0.0));
  CHECK_THROWS_AS(find_pairs(p, {{3.99, 0.0, 0.0}}, 0.0), mergel::InputError);
  CHECK_THROWS_AS(find_pairs(p, {{4.0, 0.0, 0.0}}, 0.1), mergel::InputError);
  CHECK(find_pairs(Particles{}, {}, 1.0).empty());
}
