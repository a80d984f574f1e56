// coupling/README.md, Time step: the largest frequency of an assembly with the far field
// that it touches.
#include "coupling/far_field_structure.h"
#include "coupling/structure_system.h"
#include "dem/assembly/step.h"
#include "dem/assembly/timestep.h"
#include "tests/support/catch.h"
#include "tests/support/small_chamber.h"

using namespace mergel;
using namespace mergel::coupling;
using dem::Vec3;

namespace {

/// A small elastic far field, and an assembly in the region that it surrounds.
struct Chamber {
  FarFieldStructure far_field;
  Interface interface;
  dem::Assembly assembly;
  StructureSystem system;

  /// @param E of the contacts [Pa]
  explicit Chamber(double E)
      : far_field(fem::FarField(small_chamber()), FarFieldStructure::Model::elastic, 0.0),
        interface(far_field.interface(dem::LinearMaterial{E, 2.0, 0.3, 0.0})),
        system({{&far_field, &interface.transfer, 0}})
  {
    assembly.material.contact = dem::LinearMaterial{E, 2.0, 0.3, 0.0};
    assembly.motion.damping = 0.0;
    assembly.list = dem::VerletList(0.0, 1e-4);
    assembly.walls.push_back(interface.wall);
  }

  void add(const Vec3& x, double R)
  {
    dem::ParticleState b;
    b.R = R;
    b.m = dem::sphere_mass(R, 2500.0);
    b.x = x;
    assembly.particles.add(b);
  }

  dem::StableStep stable_step()
  {
    dem::StableStep step;
    dem::find_stable_step(step, assembly, {}, 0.0, 0.0, &system);
    return step;
  }
};

} // namespace

TEST_CASE("the step of an elastic far field that no particle touches is its own",
          "[verification][coupling]")
{
  Chamber c(1e9);
  c.add({0.0, 2e-3, -5e-3}, 0.5e-3);
  const double alone = c.far_field.far_field().stable_time_step();
  // Both by Lanczos: to 1e-6 and, here, until two products raise omega^2 by less than 1e-4.
  CHECK(c.stable_step().limit == Approx(alone).epsilon(1e-3));
}

TEST_CASE(
    "no frequency of a far field with equalised masses is above the one asked for, nor "
    "far below, and true masses give the former one",
    "[verification][coupling]")
{
  Chamber c(1e9);
  c.add({0.0, 2e-3, -5e-3}, 0.5e-3);
  const double before = c.stable_step().omega2;
  const double omega2 = 3.0 * before;
  const std::vector<double> nothing_coupled(c.far_field.far_field().interface().x.size());
  c.far_field.equalise_frequencies(omega2, nothing_coupled);
  const double equalised = c.stable_step().omega2;
  CHECK(equalised < omega2);
  CHECK(equalised > 0.3 * omega2); // Gershgorin's bound of the stiffness
  c.far_field.restore_masses();
  CHECK(c.stable_step().omega2 == before);
}

TEST_CASE("at the step of particles eight times as fast, a far field with equalised masses "
          "comes to rest in a fifth of the steps",
          "[verification][coupling]")
{
  // Roller walls and more initial stress than the weight gives: it heaves.
  const auto settle = [](bool equalised) {
    fem::FarFieldSpec spec = small_chamber();
    spec.K0 = 0.5;
    spec.damping = 0.7;
    FarFieldStructure far_field(fem::FarField(spec), FarFieldStructure::Model::elastic,
                                0.0);
    const std::size_t n_nodes = far_field.far_field().interface().x.size();
    const Nodal no_force(n_nodes, Vec3::Zero());
    const double omega = 8.0 * 2.0 / far_field.far_field().stable_time_step();
    if (equalised)
      far_field.equalise_frequencies(omega * omega, std::vector<double>(n_nodes));
    const double dt = 0.9 * 2.0 / (omega * std::sqrt(1.0 + spec.damping));
    int n = 0;
    for (; n < 50000 && (n % 10 != 0 || n == 0 || far_field.unbalanced_ratio() > 1e-5); ++n)
      far_field.step(dt, no_force);
    Nodal u;
    far_field.positions(u);
    return std::pair{n, u.front().z() - far_field.far_field().interface().x.front().z()};
  };
  const auto [n_true, u_true] = settle(false);
  const auto [n_equal, u_equal] = settle(true);
  CAPTURE(n_true, n_equal, u_true);
  CHECK(5 * n_equal < n_true);
  CHECK(u_equal == Approx(u_true).epsilon(1e-3));
}

TEST_CASE(
    "particles that are much stiffer for their mass than the far field rule the step, "
    "and their wall adds to it",
    "[verification][coupling]")
{
  // A particle pressed on the floor, whose nodes are so heavy that they stay: k_n = E pi R.
  const double E = 1e13, R = 0.2e-3;
  Chamber c(E);
  const double floor = -small_chamber().region_height;
  c.add({0.5e-3, 2.1e-3, floor + R - 1e-6}, R);
  const dem::StableStep step = c.stable_step();
  const double k_n = E * dem::pi * R, m = c.assembly.particles.state[0].m;
  const double held = k_n / m;
  CAPTURE(step.omega2 / held);
  CHECK(step.omega2 > (1.0 - 1e-3) * held);
  // The floor moves too: m over the mass of the three nodes of its triangle is added.
  CHECK(step.omega2 < 1.5 * held);
  CHECK(step.bound2 == Approx(2.0 * held).epsilon(1e-9)); // of a wall that may move
  CHECK(step.wall_stiffness == Approx(k_n).epsilon(1e-9));
}

TEST_CASE("the coupled linear system is symmetric: no exchange of motion and force is lost",
          "[verification][coupling]")
{
  // With N and N^T the work of the wall on a structure is that of the structure on it.
  Chamber c(1e9);
  const StructureSystem& s = c.system;
  const std::size_t n = s.size();
  REQUIRE(n == c.far_field.n_amplitudes());
  std::vector<double> y(n), of_f(n);
  for (std::size_t k = 0; k < n; ++k) y[k] = std::sin(0.3 + 1.7 * double(k % 101));
  std::vector<std::vector<Vec3>> f(1), u(1);
  for (std::size_t k = 0; k < c.assembly.walls[0].x.size(); ++k)
    f[0].emplace_back(std::sin(0.1 * double(k)), std::cos(0.7 * double(k)), 1.0);
  u[0].resize(f[0].size());
  s.move(y, u);
  s.multiply(std::vector<double>(n, 0.0), f, of_f);
  double on_wall = 0.0, on_structure = 0.0;
  for (std::size_t k = 0; k < f[0].size(); ++k) on_wall += f[0][k].dot(u[0][k]);
  for (std::size_t k = 0; k < n; ++k) on_structure += y[k] * of_f[k];
  CHECK(on_structure == Approx(on_wall).epsilon(1e-12));
}
