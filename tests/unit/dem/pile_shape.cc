#include "tests/support/dem_scene.h"

#include "dem/walls/surfaces.h"

#include <catch2/catch.hpp>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Diameter 1.4 mm, cone of 60 degrees; its tip is at (1, 2, -3) mm.
Pile pile()
{
  Pile s;
  s.R = 0.7e-3;
  s.cone_height = 0.7e-3 * std::sqrt(3.0);
  s.x_axis = 1e-3;
  s.y_axis = 2e-3;
  s.z_tip = -3e-3;
  s.v_z = -1.35;
  return s;
}

constexpr double R = 0.2e-3;

/// A particle at radius r and height z over the tip, in the direction phi.
ParticleState at(double r, double z, double phi)
{
  return sphere({1e-3 + r * std::cos(phi), 2e-3 + r * std::sin(phi), -3e-3 + z}, R);
}

} // namespace

TEST_CASE("The closest point of the pile lies on its cone, shoulder, shaft or tip",
          "[unit][dem]")
{
  const Pile s = pile();
  const double phi = GENERATE(0.0, 1.0, 4.0);
  const Vec3 e_r(std::cos(phi), std::sin(phi), 0.0), tip(1e-3, 2e-3, -3e-3);
  const auto check_closest_point = [&](double r, double z, double r_foot, double z_foot) {
    const auto m = s.closest_point(at(r, z, phi));
    const Vec3 foot = tip + r_foot * e_r + z_foot * Vec3::UnitZ();
    const Vec3 n = (foot - at(r, z, phi).x).normalized();
    CHECK((m.geometry.point - foot).norm() < 1e-15);
    CHECK((m.geometry.n - n).norm() < 1e-12);
    CHECK(m.geometry.gap == Approx(std::hypot(r - r_foot, z - z_foot) - R).epsilon(1e-10));
    CHECK(m.geometry.v == Vec3(0.0, 0.0, -1.35));
    return m.part;
  };
  using Part = Pile::Part;
  const double h = s.cone_height;
  // outwards from the middle of the cone, along its normal (cos 30, -sin 30)
  const double c30 = std::sqrt(3.0) / 2.0;
  CHECK(check_closest_point(0.5 * s.R + 0.3e-3 * c30, 0.5 * h - 0.15e-3, 0.5 * s.R,
                            0.5 * h) == Part::cone);
  CHECK(check_closest_point(s.R + 0.25e-3, h + 1e-3, s.R, h + 1e-3) == Part::shaft);
  CHECK(check_closest_point(s.R + 0.25e-3, h - 0.05e-3, s.R, h) ==
        Part::cone); // the shoulder's edge
  CHECK(check_closest_point(0.02e-3, -0.3e-3, 0.0, 0.0) == Part::cone); // beside the axis
  CHECK(check_closest_point(0.0, -0.3e-3, 0.0, 0.0) == Part::cone);     // on it
  CHECK(s.z_shoulder() == Approx(-3e-3 + h));
}

TEST_CASE("No point of the pile's meridian is closer than the closest point", "[unit][dem]")
{
  const Pile s = pile();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> r(0.0, 1.5e-3), z(-1e-3, 3e-3);
  int n_outside = 0;
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double r_k = r(random), z_k = z(random);
    const bool inside = z_k > 0.0 && r_k < s.R * std::min(1.0, z_k / s.cone_height);
    if (inside) {
      CHECK_THROWS_AS(s.closest_point(at(r_k, z_k, 0.3)), mergel::NumericalError);
      continue;
    }
    ++n_outside;
    const double gap = s.closest_point(at(r_k, z_k, 0.3)).geometry.gap;
    for (int j = 0; j <= 400; ++j) {
      const double t = j * 0.01;
      const double r_j = t < 1.0 ? t * s.R : s.R, z_j = s.cone_height * t;
      worst = std::max(worst, gap - (std::hypot(r_j - r_k, z_j - z_k) - R));
    }
  }
  CHECK(n_outside > 1000);
  CHECK(worst < 1e-15);
}

TEST_CASE("The resultant of the pile is split between cone and shaft", "[unit][dem]")
{
  const Pile s = pile();
  const LinearMaterial law = contact(1e9, 2.0, 0.2, 0.0);
  Particles p;
  p.add(at(0.0, -0.19e-3, 0.0));                       // under the tip
  p.add(at(s.R + 0.19e-3, s.cone_height + 1e-3, 0.0)); // beside the shaft
  p.add(at(5e-3, 0.0, 0.0));                           // far away
  SurfaceContacts contacts;
  contacts.rebuild(p, law.g_a, 1e-4, Vec3::Zero(),
                   [&](const ParticleState& b) { return s.closest_point(b).geometry.gap; });
  REQUIRE(contacts.contacts().size() == 2);
  PairLosses losses;
  const PileLoad load = add_pile_forces(law, s, 0.0, p, contacts, losses);
  const double f = 1e9 * pi * R * 1e-5;
  CHECK(load.cone.value().z() == Approx(f).epsilon(1e-9)); // the particle pushes up
  CHECK(load.shaft.value().x() == Approx(-f).epsilon(1e-9));
  CHECK((load.cone.value() + p.load[0].f).norm() < 1e-12);
  CHECK((load.shaft.value() + p.load[1].f).norm() < 1e-12);

  p.state[1].x.x() = 1.1e-3;
  CHECK_THROWS_AS(add_pile_forces(law, s, 0.0, p, contacts, losses),
                  mergel::NumericalError);
}
