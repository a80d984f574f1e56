#include "tests/support/catch.h"

#include "dem/error.h"
#include "dem/math/random.h"
#include "dem/specimen/region.h"

#include <algorithm>
#include <cmath>

using namespace mergel::dem;

namespace {

const PeriodicBox box{{2.0, 3.0, 4.0}};
const Cylinder cylinder{1.5, 2.5, 7};
const HalfCylinder half{1.5, 2.5, 5};

/// Share of the bounding box that lies inside the region, from n random points.
double share_inside(const Region& region, int n)
{
  int inside = 0;
  for (int k = 0; k < n; ++k) {
    const auto id = static_cast<std::uint64_t>(k);
    const Vec3 u(uniform(3, id, 0), uniform(3, id, 1), uniform(3, id, 2));
    inside += depth(region, place(region, u)) >= 0.0;
  }
  return static_cast<double>(inside) / n;
}

} // namespace

TEST_CASE("The volume of a region is its share of its bounding box", "[unit][dem]")
{
  for (const Region& region : {Region(box), Region(cylinder), Region(half)}) {
    const Bounds b = bounds(region);
    const double of_box = volume(region) / (b.high - b.low).prod();
    // 20,000 points: three standard deviations of 0.0035.
    CHECK(share_inside(region, 20000) == Approx(of_box).margin(0.0105));
  }
  CHECK(volume(box) == 24.0);
}

TEST_CASE("The depth of a point is its distance to the nearest solid face", "[unit][dem]")
{
  const Region region = cylinder;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Vec3 x = place(region, {uniform(5, k, 0), uniform(5, k, 1), uniform(5, k, 2)});
    if (depth(region, x) < 0.0) continue;
    double nearest = 1e9;
    for (const Face& f : solid_faces(region))
      nearest = std::min(nearest, (x - f.point).dot(f.inwards));
    // Where two chords are equally near, the sector chooses one; they differ by round-off.
    CHECK(depth(region, x) == Approx(nearest).margin(1e-12));
  }
  CHECK(solid_faces(region).size() == 9); // seven chords and two ends
  CHECK(solid_faces(box).empty());
  CHECK(std::isinf(depth(box, {9.0, 9.0, 9.0})));
}

TEST_CASE("is_inside_by() agrees with the depth of a point", "[unit][dem]")
{
  int n_inside = 0;
  const auto compare = [&](const auto& shape, double margin) {
    for (std::uint64_t k = 0; k < 20000; ++k) {
      const Vec3 x = place(shape, {uniform(6, k, 0), uniform(6, k, 1), uniform(6, k, 2)});
      if (is_inside_by(shape, x, margin) != (depth(shape, x) >= margin)) return false;
      n_inside += is_inside_by(shape, x, margin);
    }
    return true;
  };
  // At a margin near half the smallest width no point is inside; the chords of these prisms
  // are far from their circle.
  for (const double margin : {0.01, 0.2, 0.5, 1.1, 2.0}) {
    CHECK(compare(box, margin));
    CHECK(compare(cylinder, margin));
    CHECK(compare(half, margin));
  }
  CHECK(n_inside > 120000); // of 300,000; 100,000 are in the box, which has no boundary
}

TEST_CASE("The cut of a half cylinder bounds it and is no solid face", "[unit][dem]")
{
  CHECK(depth(half, {0.0, 0.1, -1.0}) == Approx(0.1));
  for (const Face& f : solid_faces(half)) CHECK(f.inwards != Vec3(Vec3::UnitY()));
  CHECK(solid_faces(half).size() == 7);
}

TEST_CASE("Only a box has a periodic cell, and its axis goes through its centre",
          "[unit][dem]")
{
  CHECK(cell_of(box).size == box.size);
  CHECK_FALSE(cell_of(cylinder).is_periodic());
  CHECK(axis_distance(box, {1.0, 1.5, 0.3}) == 0.0);
  CHECK(axis_distance(half, {0.3, 0.4, -1.0}) == Approx(0.5));
}

TEST_CASE("A region without extent is refused", "[unit][dem]")
{
  CHECK_THROWS_AS(check(Region(PeriodicBox{{1.0, 0.0, 1.0}})), mergel::InputError);
  CHECK_THROWS_AS(check(Region(Cylinder{1.0, 1.0, 2})), mergel::InputError);
  CHECK_THROWS_AS(check(Region(HalfCylinder{0.0, 1.0, 8})), mergel::InputError);
  CHECK_NOTHROW(check(Region(half)));
}
