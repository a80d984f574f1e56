// What a particle feels of the triangles of a wall: nothing on a plane, no jump in a valley, and
// on a cylinder less the finer they are (dem/README.md, Walls).
#include "tests/support/catch.h"
#include "tests/support/wall_patches.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

TEST_CASE("Edges and corners of a triangulated plane are not felt", "[verification][dem]")
{
  const ContactLaw law = GENERATE(ContactLaw(rough), ContactLaw(hertz(0.3)));
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> u(0.0, 2.0 * pi);
  int n_sliding = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(u(random), random_vector(random).normalized()).matrix();
    Wall mesh = bumpy_grid(R, 0.0, 3, law), plane = folded_square(0.0, law);
    for (Vec3& x : mesh.x) x = turn * x;
    // Its hinge is 3 radii from the path.
    for (Vec3& x : plane.x) x = turn * (x + Vec3(2.5 * R, -2.0 * R, 0.0));
    Probe on_mesh(mesh), on_plane(plane);
    // Along the edge between two corners, from beyond one to beyond the other; or anywhere.
    const Vec3 from = mesh.x[12];
    Vec3 to = mesh.x[trial % 2 == 0 ? 13 : 18];
    if (trial % 4 == 3) to += 0.1 * R * (turn * Vec3(1.0, 2.0, 0.0));
    constexpr int n = 1000;
    constexpr double dt = 1e-6;
    const auto at = [&](int k) -> Vec3 {
      const double s = 1.4 * k / n - 0.2;
      return from + s * (to - from) + turn.col(2) * R * (0.97 + 0.005 * std::sin(7.0 * s));
    };
    const Vec3 omega = 300.0 * random_vector(random);
    double size = 0.0;
    for (int k = 1; k <= n; ++k) {
      for (Probe* probe : {&on_mesh, &on_plane}) {
        probe->p.state[0].v = (at(k) - at(k - 1)) / dt;
        probe->p.state[0].omega = omega;
        probe->force_at(at(k), dt);
      }
      const Load &a = on_mesh.p.load[0], &b = on_plane.p.load[0];
      size = std::max(size, b.f.norm());
      worst = std::max({worst, (a.f - b.f).norm() / size, (a.t - b.t).norm() / (size * R)});
    }
    n_sliding += on_plane.losses.slip.value() > 0.0;
  }
  CHECK(n_sliding == 20);
  CHECK(worst < 1e-10);
}

TEST_CASE(
    "Shear force and torque in a valley are continuous, and their work is stored or lost",
    "[verification][dem]")
{
  const ContactLaw law = GENERATE(ContactLaw(rough), ContactLaw(hertz(0.3)));
  const double degrees = GENERATE(5.0, 15.0, 29.0);
  const Vec3 along = Vec3(1.0, 1.0, 0.0).normalized(),
             across = Vec3(1.0, -1.0, 0.0).normalized();
  struct Result {
    double jump = 0.0, unexplained = 0.0;
  };
  // To the other side and back, in n steps, with little slip or with much.
  const double amplitude = GENERATE(0.003, 0.3);
  const auto roll = [&](int n) {
    Probe probe(folded_square(degrees * pi / 180.0, law));
    const double dt = 1e-3 / n;
    const auto at = [&](int k) -> Vec3 {
      const double a = 2.0 * pi * k / n;
      return amplitude * R * (std::cos(a) * across + 0.3 * std::sin(a) * along) +
             Vec3(0.0, 0.0, (0.985 + 0.01 * std::sin(3.0 * a)) * R);
    };
    Result r;
    double work = 0.0, largest = 0.0;
    probe.force_at(at(0));
    const double start = probe.stored();
    for (int k = 1; k <= n; ++k) {
      const Load before = probe.p.load[0];
      ParticleState& b = probe.p.state[0];
      b.v = (at(k) - at(k - 1)) / dt;
      b.omega = 100.0 * amplitude * along;
      probe.force_at(at(k), dt);
      const Load& now = probe.p.load[0];
      r.jump = std::max(r.jump, (now.t - before.t).norm() / R);
      work += 0.5 * dt * ((now.f + before.f).dot(b.v) + (now.t + before.t).dot(b.omega));
      largest = std::max(largest, probe.stored());
      r.unexplained = std::max(r.unexplained, std::abs(work + probe.stored() - start +
                                                       probe.losses.slip.value()));
    }
    r.jump /= 0.3 * probe.p.load[0].f.norm();
    r.unexplained /= largest;
    return r;
  };
  const Result coarse = roll(2000), fine = roll(16000);
  CAPTURE(degrees, amplitude, coarse.jump, fine.jump, coarse.unexplained, fine.unexplained);
  // Eight times the steps: first order.
  CHECK(fine.jump < 0.2 * coarse.jump);
  CHECK(fine.unexplained < 0.2 * coarse.unexplained);
}

TEST_CASE("A fine mesh of a hollow cylinder presses as the cylinder", "[verification][dem]")
{
  const double rho = 3.0 * R, overlap = 0.04 * R;
  const double wanted = normal_force(smooth, sides_at_wall(R), overlap);
  std::vector<double> radial, lateral; // largest errors over the force of the cylinder
  for (const int n : {48, 96, 192}) {
    std::vector<Vec3> x;
    std::vector<Triangle> triangles;
    const double cell = 2.0 * pi * rho / n;
    const int rows = static_cast<int>(2.0 * R / cell) + 1;
    for (int j = -rows; j <= rows; ++j)
      for (int i = 0; i < n; ++i) {
        const double a = 2.0 * pi * i / n;
        x.push_back({rho * std::cos(a), rho * std::sin(a), cell * j});
      }
    for (int j = 0; j < 2 * rows; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = n * j + i, b = n * j + (i + 1) % n;
        triangles.push_back({a, b + n, b});
        triangles.push_back({a, a + n, b + n});
      }
    Probe probe(make_wall(x, triangles, smooth));
    REQUIRE(probe.wall.topology.n_patches == 1);
    std::mt19937_64 random(2);
    double across = 0.0, aside = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
      const Vec3 u = random_vector(random);
      const Vec3 e(std::cos(pi * u.x()), std::sin(pi * u.x()), 0.0);
      const Vec3 f =
          probe.force_at((rho - R - g_a + overlap) * e + 0.5 * R * u.z() * Vec3::UnitZ());
      across = std::max(across, std::abs(f.dot(e) + wanted) / wanted);
      aside = std::max(aside, (f - f.dot(e) * e).norm() / wanted);
    }
    radial.push_back(across);
    lateral.push_back(aside);
  }
  CAPTURE(radial, lateral);
  for (std::size_t k = 0; k < 2; ++k) {
    // The facets lie by a sagitta inside: its square order.
    CHECK(radial[k] / radial[k + 1] == Approx(4.0).epsilon(0.1));
    // The energy differs by that much between facet and edge, over the length of a facet.
    CHECK(lateral[k] / lateral[k + 1] == Approx(2.0).epsilon(0.15));
  }
}
