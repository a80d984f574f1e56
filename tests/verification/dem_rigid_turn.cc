#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

struct RotationErrors {
  double load_error =
      0.0; ///< of N, V, M and the contact's shear, relative, after the full rotation
  double unstressed =
      0.0;                ///< force that a pair without loads gets, relative to the other's
  double resultant = 0.0; ///< sum of forces and of moments, relative
};

/// A pair of unequal particles with a gap, bonded or in contact.
Scene pair(bool is_bonded, const Vec3& along)
{
  Scene s;
  s.material = {unbreakable_bond(), contact(0.63e9, 2.4, 1e6, 2e-3)};
  s.p.add(sphere({0.01, 0.02, -0.03}, 0.03));
  s.p.add(sphere(Vec3(0.01, 0.02, -0.03) + 0.0512 * along, 0.02));
  is_bonded ? s.bond({{0, 1}}) : s.add_contacts({{0, 1}});
  return s;
}

/// Twists, shears and pulls the second particle a little.
void strain(Scene& s)
{
  const double dt = 1e-5;
  s.p.state[0].omega = {0.3, -0.5, 0.2};
  s.p.state[1].omega = {-0.4, 0.1, 0.6};
  s.p.state[1].v = {0.02, -0.03, 0.01};
  s.p.state[1].x += dt * s.p.state[1].v;
  s.forces(dt);
}

std::vector<Vec3> loads(const Scene& s)
{
  if (s.bonds.size() == 0) return {s.contacts.shear[0].f_s};
  const BondReading r = read_bond(s.bonds, 0, s.p, s.cell, s.material.bond);
  const Vec3 n = (s.p.state[1].x - s.p.state[0].x).normalized();
  const Vec3 f_s = vec3(lane(s.bonds.blocks[0].f_s, 0));
  return {r.N * n, r.V, r.M, f_s};
}

RotationErrors turn(bool is_bonded, const Vec3& along, const Vec3& axis, int N)
{
  Scene s = pair(is_bonded, along), virgin = pair(is_bonded, along);
  strain(s);
  const auto before = loads(s);
  RotationErrors out;
  const double dt = 1e-4, angle = 2.0 * pi / N;
  const Mat3 Q = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  const Vec3 centre(0.1, 0.0, 0.05);
  for (Scene* scene : {&s, &virgin}) {
    for (int k = 0; k < N; ++k) {
      for (ParticleState& b : scene->p.state) {
        const Vec3 x = centre + Q * (b.x - centre);
        b.v = (x - b.x) / dt;
        b.x = x;
        b.omega = angle / dt * axis.normalized();
      }
      scene->forces(dt);
      const Load &i = scene->p.load[0], &j = scene->p.load[1];
      const Vec3 arm = scene->p.state[1].x - scene->p.state[0].x;
      const double scale = std::max(i.f.norm(), 1e-300);
      out.resultant = std::max(out.resultant, (i.f + j.f).norm() / scale);
      out.resultant = std::max(out.resultant,
                               (i.t + j.t + arm.cross(j.f)).norm() / (scale * arm.norm()));
    }
  }
  const auto after = loads(s);
  for (std::size_t k = 0; k < before.size(); ++k) {
    REQUIRE(before[k].norm() > 0.0);
    out.load_error =
        std::max(out.load_error, (after[k] - before[k]).norm() / before[k].norm());
  }
  const auto none = loads(virgin);
  for (std::size_t k = 0; k < none.size(); ++k)
    out.unstressed = std::max(out.unstressed, none[k].norm() / before[k].norm());
  return out;
}

} // namespace

TEST_CASE("A loaded pair rotated by 360 degrees keeps its loads to second order",
          "[verification][dem]")
{
  // About the axis of the pair, normal to it and obliquely; an unstressed pair stays so.
  const bool is_bonded = GENERATE(true, false);
  const Vec3 along = Vec3(1.0, 2.0, 2.0) / 3.0, across = Vec3(2.0, -2.0, 1.0) / 3.0;
  for (const Vec3& axis : {along, across, Vec3(0.0, 0.0, 1.0), Vec3(0.3, -0.9, 0.5)}) {
    const RotationErrors coarse = turn(is_bonded, along, axis, 10000);
    const RotationErrors fine = turn(is_bonded, along, axis, 20000);
    CAPTURE(is_bonded, axis.transpose(), coarse.load_error, fine.load_error,
            coarse.unstressed, fine.unstressed);
    // History rotates with the pair up to 250/N^2; the arc against its chord leaves
    // (2 pi)^3/(6 N^2) |r| of shear, |r| = 51 mm against the 0.2 um of the load.
    CHECK(fine.load_error < 1e8 / (20000.0 * 20000.0));
    if (coarse.load_error > 1e-5) // else it is round-off
      CHECK(coarse.load_error / fine.load_error > 3.5);
    CHECK(fine.unstressed < 1e8 / (20000.0 * 20000.0));
    CHECK(fine.resultant < 1e-12);
  }
}
