#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/walls/rigid_wall.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Diameter 1.4 mm, cone of 60 degrees.
const Revolution cone = cone_ended(0.7e-3, 0.7e-3 * std::sqrt(3.0));
const Revolution flat = flat_ended(0.7e-3);
/// A blunt tip of two slopes.
const Revolution blunt{{{0.0, 0.0}, {0.4e-3, 0.1e-3}, {0.7e-3, 0.5e-3}}};
const Vec3 lowest(1e-3, 2e-3, -3e-3);

constexpr double R = 0.2e-3;

/// A particle at radius r and height z over the tip, in the direction phi.
ParticleState at(double r, double z, double phi)
{
  return sphere({1e-3 + r * std::cos(phi), 2e-3 + r * std::sin(phi), -3e-3 + z}, R);
}

} // namespace

TEST_CASE("The closest point of a cone-ended wall lies on its cone, shoulder, shaft or tip",
          "[unit][dem]")
{
  const double phi = GENERATE(0.0, 1.0, 4.0);
  const Vec3 e_r(std::cos(phi), std::sin(phi), 0.0);
  const auto part_at = [&](double r, double z, double r_foot, double z_foot) {
    const SurfacePoint m = cone.closest_point(at(r, z, phi), lowest);
    const Vec3 foot = lowest + r_foot * e_r + z_foot * Vec3::UnitZ();
    CHECK((m.point - foot).norm() < 1e-15);
    CHECK((m.n - (foot - at(r, z, phi).x).normalized()).norm() < 1e-12);
    CHECK(m.gap == Approx(std::hypot(r - r_foot, z - z_foot) - R).epsilon(1e-10));
    return m.part;
  };
  const double h = cone.tip_height();
  // outwards from the middle of the cone, along its normal (cos 30, -sin 30)
  const double c30 = std::sqrt(3.0) / 2.0;
  CHECK(part_at(0.5 * cone.R() + 0.3e-3 * c30, 0.5 * h - 0.15e-3, 0.5 * cone.R(),
                0.5 * h) == Revolution::tip);
  CHECK(part_at(cone.R() + 0.25e-3, h + 1e-3, cone.R(), h + 1e-3) == Revolution::shaft);
  CHECK(part_at(cone.R() + 0.25e-3, h - 0.05e-3, cone.R(), h) ==
        Revolution::tip);                                        // the shoulder's edge
  CHECK(part_at(0.02e-3, -0.3e-3, 0.0, 0.0) == Revolution::tip); // beside the axis
  CHECK(part_at(0.0, -0.3e-3, 0.0, 0.0) == Revolution::tip);     // on it
}

TEST_CASE("Under a flat end the closest point is straight above, beside it on the edge",
          "[unit][dem]")
{
  const double phi = GENERATE(0.0, 2.5);
  const SurfacePoint under = flat.closest_point(at(0.3e-3, -0.25e-3, phi), lowest);
  CHECK((under.n - Vec3::UnitZ()).norm() < 1e-12);
  CHECK(under.gap == Approx(0.05e-3).epsilon(1e-10));
  CHECK(under.part == Revolution::tip);

  const SurfacePoint at_edge = flat.closest_point(at(1e-3, -0.4e-3, phi), lowest);
  CHECK(at_edge.gap == Approx(0.5e-3 - R).epsilon(1e-10)); // a 3-4-5 triangle
  CHECK(at_edge.part == Revolution::tip);
  CHECK(flat.closest_point(at(1e-3, 0.1e-3, phi), lowest).part == Revolution::shaft);
  CHECK_THROWS_AS(flat.closest_point(at(0.6e-3, 0.1e-3, phi), lowest),
                  mergel::NumericalError);
}

TEST_CASE("No point of the profile is closer than the closest point", "[unit][dem]")
{
  const Revolution& shape = *GENERATE(&cone, &flat, &blunt);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> r(0.0, 1.5e-3), z(-1e-3, 3e-3);
  // Radius of the profile at a height above the tip.
  const auto radius_at = [&](double height) {
    for (std::size_t k = 1; k < shape.profile.size(); ++k) {
      const auto &a = shape.profile[k - 1], &b = shape.profile[k];
      if (height < b.z) return a.r + (b.r - a.r) * (height - a.z) / (b.z - a.z);
    }
    return shape.R();
  };
  int n_outside = 0;
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double r_k = r(random), z_k = z(random);
    const ParticleState b = at(r_k, z_k, 0.3);
    if (z_k > 0.0 && r_k < radius_at(z_k)) {
      CHECK_THROWS_AS(shape.closest_point(b, lowest), mergel::NumericalError);
      continue;
    }
    ++n_outside;
    const double gap = shape.closest_point(b, lowest).gap;
    const auto compare = [&](double r_j, double z_j) {
      worst = std::max(worst, gap - (std::hypot(r_j - r_k, z_j - z_k) - R));
    };
    for (int j = 0; j <= 400; ++j) compare(radius_at(0.01e-3 * j), 0.01e-3 * j);
    for (int j = 0; j <= 100; ++j) // horizontal pieces have no height of their own
      compare(0.01 * j * shape.profile[1].r, 0.01 * j * shape.profile[1].z);
  }
  CHECK(n_outside > 1000);
  CHECK(worst < 1e-15);
}

TEST_CASE("A profile must be convex and run outwards and upwards", "[unit][dem]")
{
  for (const Revolution* shape : {&cone, &flat, &blunt}) CHECK_NOTHROW(shape->check());
  const auto refuses = [](std::vector<Revolution::Corner> profile) {
    CHECK_THROWS_AS(Revolution{std::move(profile)}.check(), mergel::InputError);
  };
  refuses({{0.0, 0.0}});
  refuses({{0.1, 0.0}, {1.0, 1.0}});
  refuses({{0.0, 0.0}, {1.0, -0.1}});
  refuses({{0.0, 0.0}, {0.0, 1.0}});
  refuses({{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.5}});
}

TEST_CASE("The resultant of a body of revolution is split between tip and shaft",
          "[unit][dem]")
{
  const LinearMaterial law = contact(1e9, 2.0, 0.2, 0.0);
  RigidWall wall = make_rigid_wall(cone, lowest, law);
  Particles p;
  p.add(at(0.0, -0.19e-3, 0.0));                                // under the tip
  p.add(at(cone.R() + 0.19e-3, cone.tip_height() + 1e-3, 0.0)); // beside the shaft
  p.add(at(5e-3, 0.0, 0.0));                                    // far away
  rebuild_wall(wall, {}, p, 1e-4);
  REQUIRE(wall.contacts.size() == 2);
  PairLosses losses;
  add_wall_forces(wall, {}, 0.0, p, losses);
  const double f = 1e9 * pi * R * 1e-5;
  const Vec3 tip = wall.force[Revolution::tip].value(),
             shaft = wall.force[Revolution::shaft].value();
  CHECK(tip.z() == Approx(f).epsilon(1e-9)); // the particle pushes up
  CHECK(shaft.x() == Approx(-f).epsilon(1e-9));
  CHECK((tip + p.load[0].f).norm() < 1e-12);
  CHECK((shaft + p.load[1].f).norm() < 1e-12);
  CHECK((wall.resultant() - tip - shaft).norm() == 0.0);
  wall.v = {0.0, 0.0, -1.35};
  CHECK(power(wall) == Approx(1.35 * f).epsilon(1e-9)); // a wall that presses does work

  p.state[1].x.x() = 1.1e-3;
  CHECK_THROWS_AS(add_wall_forces(wall, {}, 0.0, p, losses), mergel::NumericalError);
}
