// The explicit motion of fem/ against closed forms: fem/README.md, 6. Explicit step,
// 7. Stable step, 10. Energy.
#include "tests/support/catch.h"

#include "tests/verification/fem_solids.h"

#include "fem/solid/leapfrog.h"
#include "fem/solver/linear_solver.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

using namespace mergel::fem;
using namespace mergel::fem::test;

namespace {

using std::numbers::pi;

NodalField zero(const ElasticSolid& solid)
{
  return NodalField::Zero(4, static_cast<Eigen::Index>(solid.discrete().n_nodes()));
}

double balance(const Energies& e)
{
  return e.kinetic + e.strain - e.interface_work - e.gravity_work - e.initial_stress_work +
         e.damping;
}

} // namespace

// Kolsky (1963), Stress Waves in Solids: plane dilatational wave, c^2 = (lambda + 2 G)/rho.
TEST_CASE("A constrained bar oscillates at the P wave speed sqrt((lambda + 2 G)/rho)",
          "[verification][fem]")
{
  const Elastic e{1.1e9, 0.14};
  const double rho = 1227.0, L = 1.0;
  const double c = e.p_wave_speed(rho);
  const double period = 4.0 * L / c; // fixed at x = 0, free at x = L: a quarter wave

  const auto error = [&](unsigned int n) {
    const double h = L / n;
    dealii::Triangulation<3> mesh;
    make_box({L, h, h}, {n, 1, 1}, mesh);
    const ElasticSolid bar(mesh, {e, rho, Vec3::Zero(), {}, {}},
                           {{x_low, Support::fixed},
                            {y_low, Support::roller},
                            {y_high, Support::roller},
                            {z_low, Support::roller},
                            {z_high, Support::roller}});
    // Released from its first mode; u = 0 at a quarter of the period. v at -dt/2 is that of
    // the mode, v = -u_0 omega sin(-omega dt/2).
    const double dt = 0.5 * h / c, omega = 2.0 * pi / period;
    const NodalField mode = sample(bar, [&](const Vec3& x) {
      return Vec3(1e-6 * std::sin(pi * x.x() / (2.0 * L)), 0.0, 0.0);
    });
    Leapfrog motion(bar.discrete(), 0.0, {});
    NodalMotion start = motion.motion();
    start.u = mode;
    start.v = mode * (omega * std::sin(omega * dt / 2.0));
    motion.restore(start);

    const auto tip = bar.nodes_on(x_high).front();
    double t = 0.0, before = 0.0;
    while (motion.motion().u(0, tip) > 0.0) {
      before = motion.motion().u(0, tip);
      motion.step(dt, {});
      t += dt;
    }
    const double after = motion.motion().u(0, tip);
    const double crossing = t - dt * after / (after - before); // after <= 0 < before
    return std::abs(4.0 * crossing / period - 1.0);
  };
  const double coarse = error(8), fine = error(16);
  // Lumped linear elements and leapfrog at a Courant number of 1/2 are too slow by
  // (k h)^2/24 (1 - 1/4) = 3.0e-4 at 16 cells.
  CHECK(fine == Approx(std::pow(pi / 32.0, 2) / 32.0).epsilon(0.05));
  CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.1));
}

TEST_CASE("Local damping slows a free fall to g (1 - alpha) t", "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_box({1.0, 1.0, 1.0}, {2, 2, 2}, mesh);
  const double g = 9.81, alpha = 0.7, dt = 1e-5;
  const ElasticSolid block(mesh, {{1e9, 0.2}, 1000.0, Vec3(0.0, 0.0, -g), {}, {}}, {});
  Leapfrog motion(block.discrete(), alpha, {});
  const int n = 100;
  for (int i = 0; i < n; ++i) motion.step(dt, {});
  // The first kick starts from v = 0, which is not damped.
  const double v = -g * dt * (1.0 + (1.0 - alpha) * (n - 1));
  CHECK(motion.motion().v.row(2).minCoeff() == Approx(v).epsilon(1e-12));
  CHECK(motion.motion().v.row(2).maxCoeff() == Approx(v).epsilon(1e-12));
}

TEST_CASE("Damped motion of a loaded rod ends at F L/(E A)", "[verification][fem]")
{
  const double L = 1.0, side = 0.2, F = 1000.0, E = 1.1e9;
  dealii::Triangulation<3> mesh;
  make_box({L, side, side}, {5, 1, 1}, mesh);
  const ElasticSolid rod(mesh, {{E, 0.0}, 1227.0, Vec3::Zero(), {}, {}},
                         {{x_low, Support::fixed}});
  const auto loaded = rod.nodes_on(x_high);
  const auto f = pick(traction_forces(rod, x_high,
                                      [&](const Vec3&, const Vec3& n) {
                                        return Vec3(F / (side * side) * n);
                                      }),
                      loaded);
  Leapfrog motion(rod.discrete(), 0.7, loaded);
  const double dt = 0.7 * 2.0 / largest_frequency(rod.discrete()) / std::sqrt(1.7);
  for (int i = 0; i < 3000; ++i) motion.step(dt, f);
  CHECK(motion.unbalanced_ratio() < 1e-10);
  for (const auto a : loaded)
    CHECK(motion.motion().u(0, a) == Approx(F * L / (E * side * side)).epsilon(1e-8));
}

TEST_CASE("The energy is balanced to round-off at a constant time step",
          "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_box({1.0, 1.0, 1.0}, {3, 3, 3}, mesh);
  const auto stress = [](const dealii::Point<3>& x) {
    dealii::SymmetricTensor<2, 3> sigma;
    sigma[2][2] = 2e4 * x[2] - 3e4;
    sigma[0][0] = 1e4;
    return sigma;
  };
  const ElasticSolid block(mesh, {{1e9, 0.2}, 1000.0, Vec3(0.0, 0.0, -9.81), stress, {}},
                           {{z_low, Support::fixed}});
  const auto loaded = block.nodes_on(z_high);
  const double dt = 0.5 * 2.0 / largest_frequency(block.discrete());

  for (const double alpha : {0.0, 0.7}) {
    Leapfrog motion(block.discrete(), alpha, loaded);
    std::vector<Vec3> f(loaded.size());
    const auto run = [&](int n, double step) {
      for (int i = 0; i < n; ++i) {
        for (auto& force : f) force = Vec3(300.0 * std::sin(0.1 * i), 100.0, -50.0 * i / n);
        motion.step(step, f);
      }
    };
    run(400, dt);
    const Energies e = motion.energies();
    const double size = std::abs(e.interface_work) + std::abs(e.gravity_work) +
                        std::abs(e.initial_stress_work) + e.damping;
    CHECK(e.interface_work != 0.0);
    CHECK((alpha == 0.0) == (e.damping == 0.0));
    CHECK(std::abs(balance(e)) < 1e-12 * size); // measured 2e-15 of it

    // A change of dt leaves the error of fem/README.md, 10. Energy, once.
    const NodalMotion before = motion.motion();
    motion.step(0.8 * dt, f);
    const NodalField kick = motion.motion().v - before.v;
    const double expected = (0.8 - 1.0) * dt / 4.0 * dot(motion.motion().Ku, kick);
    CHECK(balance(motion.energies()) - balance(e) ==
          Approx(expected).epsilon(1e-6).margin(1e-13 * size));
  }
}

namespace {

/// A block without supports or weight, whose upper face takes forces.
struct LoadedBlock {
  dealii::Triangulation<3> mesh;
  std::unique_ptr<ElasticSolid> solid;
  std::vector<std::uint32_t> loaded;
  double omega;

  explicit LoadedBlock(const Supports& supports)
  {
    make_box({1.0, 1.0, 1.0}, {3, 3, 3}, mesh);
    solid = std::make_unique<ElasticSolid>(
        mesh, SolidProperties{{1e9, 0.2}, 1000.0, Vec3::Zero(), {}, {}}, supports);
    loaded = solid->nodes_on(z_high);
    omega = largest_frequency(solid->discrete());
  }
  std::vector<Vec3> forces(double t) const
  {
    return std::vector<Vec3>(loaded.size(),
                             Vec3(300.0 * std::sin(0.1 * omega * t), 100.0, -50.0));
  }
};

} // namespace

TEST_CASE(
    "Subcycling passes on all momentum, and its energy balance is off by the square of "
    "the window",
    "[verification][fem]")
{
  const LoadedBlock block({});
  /// Largest error of the balance over the work, at windows of this length over 1/omega.
  const auto error_at = [&](double window, std::size_t s) {
    Leapfrog motion(block.solid->discrete(), 0.0, block.loaded);
    motion.set_subcycle(s);
    const double dt = window / (block.omega * static_cast<double>(s));
    Vec3 impulse = Vec3::Zero();
    double worst = 0.0, work = 0.0;
    const auto n = static_cast<int>(400.0 * static_cast<double>(s) / window);
    for (int i = 0; i < n; ++i) {
      const std::vector<Vec3> f = block.forces(i * dt);
      motion.step(dt, f);
      for (const Vec3& force : f) impulse += dt * force;
      const Energies e = motion.energies();
      worst = std::max(worst, std::abs(balance(e)));
      work = std::max(work, std::abs(e.interface_work));
    }
    Vec3 momentum = Vec3::Zero();
    for (Eigen::Index a = 0; a < motion.motion().v.cols(); ++a)
      momentum += block.solid->discrete().m(a) * at(motion.motion().v, a);
    // Round-off of some thousand steps.
    CHECK((momentum - impulse).norm() < 1e-11 * impulse.norm());
    return worst / work;
  };
  CHECK(error_at(0.7, 1) < 1e-11); // without it the balance holds to round-off
  const double long_window = error_at(0.7, 4), half = error_at(0.35, 4);
  CAPTURE(long_window, half);
  CHECK(long_window < 1e-4); // measured 2.0e-5, 5.0e-6
  CHECK(half < 0.3 * long_window);
}

TEST_CASE("No impulse is lost where the step changes in a window of the subcycle",
          "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_box({1.0, 1.0, 1.0}, {2, 2, 2}, mesh);
  const double g = 9.81;
  const ElasticSolid block(mesh, {{1e9, 0.2}, 1000.0, Vec3(0.0, 0.0, -g), {}, {}}, {});
  Leapfrog motion(block.discrete(), 0.0, block.nodes_on(z_high));
  motion.set_subcycle(3);
  const double dt = 0.1 / largest_frequency(block.discrete());
  const std::vector<Vec3> no_force(block.nodes_on(z_high).size(), Vec3::Zero());
  double time = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double step = (i % 7 < 4 ? 1.0 : 0.6) * dt;
    motion.step(step, no_force);
    time += step;
    // The block falls freely. v is half of the window ahead of its start, and the first kick,
    // over the whole of its step, gave half a step more.
    const NodalMotion& now = motion.motion();
    const double fallen = 0.5 * dt + (time - now.since) + 0.5 * now.window;
    for (Eigen::Index a = 0; a < now.v.cols(); ++a)
      CHECK(now.v(2, a) == Approx(-g * fallen).epsilon(1e-10));
  }
}

TEST_CASE("Damped motion under a load ends at the static solution with any subcycle, and "
          "continues from any step of a window",
          "[verification][fem]")
{
  const LoadedBlock block({{z_low, Support::fixed}});
  const std::vector<Vec3> f(block.loaded.size(), Vec3(100.0, -20.0, -300.0));
  NodalField load = zero(*block.solid);
  for (std::size_t k = 0; k < f.size(); ++k)
    load.col(block.loaded[k]).head<3>() = f[k].array();
  const NodalField exact = solve_static(block.solid->discrete(), load).u;
  for (const std::size_t s : {1, 2, 3, 4}) {
    Leapfrog motion(block.solid->discrete(), 0.7, block.loaded);
    motion.set_subcycle(s);
    const double dt = 0.7 / (static_cast<double>(s) * block.omega);
    for (int i = 0; i < 12000; ++i) motion.step(dt, f);
    while (motion.motion().n_left > 0) motion.step(dt, f);
    // At the end of a window: in between, loaded nodes go up and down.
    CAPTURE(s);
    CHECK((motion.motion().u - exact).abs().maxCoeff() < 1e-8 * exact.abs().maxCoeff());

    motion.step(dt, f);
    REQUIRE(motion.motion().n_left == s - 1);
    Leapfrog other(block.solid->discrete(), 0.7, block.loaded);
    other.restore(motion.motion());
    for (int i = 0; i < 20; ++i)
      for (Leapfrog* one : {&motion, &other}) one->step((1.0 + 0.01 * i) * dt, f);
    CHECK((motion.motion().u == other.motion().u).all());
    CHECK((motion.motion().v == other.motion().v).all());
    CHECK(motion.motion().energy.strain == other.motion().energy.strain);
  }
}

TEST_CASE("Damped motion ends at the static solution", "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_box({1.0, 0.5, 0.5}, {4, 2, 2}, mesh);
  const ElasticSolid block(mesh, {{1e9, 0.25}, 1000.0, Vec3(0.0, 0.0, -9.81), {}, {}},
                           {{x_low, Support::fixed}, {y_low, Support::roller}});
  const auto loaded = block.nodes_on(x_high);
  const NodalField load = traction_forces(block, x_high, [](const Vec3& x, const Vec3&) {
    return Vec3(1e5 * x.z(), 2e4, -3e4);
  });
  const NodalField exact =
      solve_static(block.discrete(), load + block.discrete().f_gravity).u;

  Leapfrog motion(block.discrete(), 0.7, loaded);
  const double dt = 0.7 * 2.0 / largest_frequency(block.discrete()) / std::sqrt(1.7);
  for (int i = 0; i < 6000; ++i) motion.step(dt, pick(load, loaded));
  CHECK((motion.motion().u - exact).abs().maxCoeff() < 1e-8 * exact.abs().maxCoeff());

  // A motion that starts from it stays there.
  motion.rest_at(exact, pick(load, loaded));
  CHECK(motion.unbalanced_ratio() < 1e-11); // solver tolerance 1e-12
}

TEST_CASE("Leapfrog is stable just below 2/omega_max and not just above",
          "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_box({1.0, 1.0, 0.5}, {3, 3, 2}, mesh);
  const ElasticSolid block(mesh, {{1e9, 0.2}, 1000.0, Vec3::Zero(), {}, {}},
                           {{z_low, Support::fixed}});
  const double limit = 2.0 / largest_frequency(block.discrete());
  const auto growth = [&](double share) {
    Leapfrog motion(block.discrete(), 0.0, {});
    NodalMotion start = motion.motion();
    for (Eigen::Index a = 0; a < start.u.cols(); ++a)
      start.u.col(a).head<3>() =
          (block.discrete().P[static_cast<std::size_t>(a)] *
           Vec3(std::sin(3.0 * a), std::cos(5.0 * a), std::sin(7.0 * a)))
              .array();
    motion.restore(start);
    for (int i = 0; i < 2000; ++i) motion.step(share * limit, {});
    return motion.motion().u.abs().maxCoeff();
  };
  CHECK(growth(0.999) < 100.0);
  CHECK(growth(1.001) > 1e6);
}

TEST_CASE("A state restored in a new object continues with the same bits",
          "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_box({1.0, 1.0, 1.0}, {2, 2, 2}, mesh);
  const ElasticSolid block(mesh, {{1e9, 0.2}, 1000.0, Vec3(0.0, 0.0, -9.81), {}, {}},
                           {{z_low, Support::fixed}});
  const double dt = 0.3 * 2.0 / largest_frequency(block.discrete());
  Leapfrog one(block.discrete(), 0.7, {}), other(block.discrete(), 0.7, {});
  for (int i = 0; i < 50; ++i) one.step(dt, {});
  other.restore(one.motion());
  CHECK(other.unbalanced_ratio() == one.unbalanced_ratio());
  for (int i = 0; i < 50; ++i) {
    one.step(0.9 * dt, {});
    other.step(0.9 * dt, {});
  }
  CHECK((one.motion().u == other.motion().u).all());
  CHECK((one.motion().v == other.motion().v).all());
  CHECK(one.energies().damping == other.energies().damping);

  NodalMotion wrong = one.motion();
  wrong.u = zero(block).leftCols(3);
  CHECK_THROWS_WITH(other.restore(wrong), mergel::match::Contains("3 nodes"));
  CHECK_THROWS_WITH(Leapfrog(block.discrete(), 1.0, {}),
                    mergel::match::Contains("0 <= damping < 1"));
  const std::vector<Vec3> one_force(1);
  CHECK_THROWS_WITH(one.step(dt, one_force), mergel::match::Contains("1 given"));
}
