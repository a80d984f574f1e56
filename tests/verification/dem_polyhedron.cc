#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"
#include "tests/support/polyhedra.h"

#include <algorithm>
#include <random>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 0.2e-3, R_pile = 0.7e-3, overlap = 0.05 * R;
const Revolution exact_shape = cone_ended(R_pile, R_pile* std::sqrt(3.0)); // 60 degrees
const LinearMaterial law = contact(1e9, 2.4, 0.2, 0.0);

/// Particles that press into cone, shoulder and shaft and move along them.
Particles particles_around()
{
  Particles p;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const double h = exact_shape.tip_height(), c30 = std::sqrt(3.0) / 2.0;
  for (int k = 0; k < 300; ++k) {
    const double phi = 2.0 * pi * u(random), d = R - overlap;
    double r = R_pile + d, z = h + (0.1 + 1.5 * u(random)) * 1e-3; // beside the shaft
    if (k % 3 == 1) {                                              // below the cone
      const double t = 0.1 + 0.85 * u(random);
      r = t * R_pile + d * c30;
      z = t * h - 0.5 * d;
    } else if (k % 3 == 2) { // at the edge of the shoulder
      const double down = pi / 6.0 * (0.1 + 0.8 * u(random));
      r = R_pile + d * std::cos(down);
      z = h - d * std::sin(down);
    }
    p.add(sphere({r * std::cos(phi), r * std::sin(phi), z}, R));
    p.state.back().v = 0.5 * random_vector(random);
  }
  return p;
}

struct Forces {
  std::vector<Vec3> f;
  double tip = 0.0, shaft = 0.0; ///< upwards on the pile
};

/// After one step, in which shear springs form and some contacts slip.
Forces forces_of(const RigidShape& shape)
{
  Particles p = particles_around();
  RigidWall wall = make_rigid_wall(shape, Vec3::Zero(), law);
  rebuild_wall(wall, {}, p, 1e-4);
  PairLosses losses;
  add_wall_forces(wall, {}, 2e-6, p, losses);
  Forces forces;
  for (const Load& load : p.load) forces.f.push_back(load.f);
  forces.tip = wall.force[0].z.value();
  forces.shaft = wall.force[1].z.value();
  return forces;
}

struct Errors {
  double size = 0.0, direction = 0.0, tip = 0.0;
};

/// Of a polyhedron with n chords, each corner on the true surface.
Errors errors_of(int n)
{
  const Forces exact = forces_of(exact_shape),
               meshed = forces_of(make_polyhedron(
                   cone_ended_surface(R_pile, exact_shape.tip_height(), 20e-3, n)));
  Errors e;
  for (std::size_t k = 0; k < exact.f.size(); ++k) {
    const double size = exact.f[k].norm();
    e.size = std::max(e.size, std::abs(meshed.f[k].norm() - size) / size);
    e.direction =
        std::max(e.direction, (meshed.f[k].normalized() - exact.f[k].normalized()).norm());
  }
  e.tip = std::abs(meshed.tip - exact.tip) / exact.tip;
  return e;
}

} // namespace

// The facets lie below the true surface by at most the sagitta, of the second order in the chord;
// their normals differ by half of the angle of a chord, of the first.
TEST_CASE(
    "A pile of triangles has the forces of the exact cone and shaft: sizes and tip force "
    "to second order in the facets, directions to first",
    "[verification][dem]")
{
  const Errors e_100 = errors_of(100), e_200 = errors_of(200), e_400 = errors_of(400);
  CAPTURE(e_100.size, e_200.size, e_400.size, e_100.direction, e_200.direction,
          e_400.direction, e_100.tip, e_200.tip, e_400.tip);
  const double sagitta = R_pile * (1.0 - std::cos(pi / 400));
  CHECK(e_400.size < 1.3 * sagitta / overlap); // shear forces add to the size
  CHECK(e_400.direction < 1.3 * pi / 400);
  CHECK(e_400.tip < sagitta / overlap);
  // Largest errors of 300 particles at places that the meshes share only in part.
  CHECK(e_100.size / e_400.size == Approx(16.0).epsilon(0.3));
  CHECK(e_100.direction / e_400.direction == Approx(4.0).epsilon(0.3));
  CHECK(e_100.tip / e_400.tip == Approx(16.0).epsilon(0.15));
}
