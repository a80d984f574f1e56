// The far field as the coupling uses it: fem/README.md, 5. Initial stress, 8. Static
// solution; coupling/README.md, Start of a coupled run.
#include "fem/boundary_ids.h"
#include "fem/dealii/elastic_solid.h"
#include "fem/dealii/far_field_mesh.h"
#include "fem/far_field/far_field.h"
#include "fem/solver/linear_solver.h"
#include "tests/support/catch.h"
#include "tests/support/small_chamber.h"
#include "tests/verification/fem_solids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

using namespace mergel::fem;

namespace {

using std::numbers::pi;

/// Area of half a regular polygon of 2 n sides in a circle: cross-section of a half
/// cylinder of n segments.
double half_polygon(double R, double n)
{
  return n * R * R / 2.0 * std::sin(pi / n);
}

} // namespace

TEST_CASE("The far field's initial stress is in equilibrium with the region's traction",
          "[verification][fem]")
{
  FarField field(small_chamber());
  const auto f = field.initial_interface_forces();

  // The region's weight rests on its floor.
  const double n_around = 8.0; // pi 5 mm / 2 mm = 7.9
  const double g = 9.81, weight = 1227.0 * g * 12e-3 * half_polygon(5e-3, n_around);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : f) sum += force;
  CHECK(sum.z() == Approx(-weight).epsilon(1e-10));
  CHECK(std::abs(sum.x()) < 1e-12 * weight); // mirror symmetric

  // Nothing moves: the stress is linear in depth, which two Gauss points integrate exactly.
  field.solve_static(f);
  CHECK(field.unbalanced_ratio() < 1e-13);
  const double scale = 1227.0 * g * 40e-3 / 1.1e9 * 40e-3; // settlement of such a column
  CHECK(field.motion().u.abs().maxCoeff() < 1e-10 * scale);

  const double volume =
      half_polygon(12.5e-3, n_around) * 40e-3 - half_polygon(5e-3, n_around) * 12e-3;
  CHECK(field.mass() == Approx(1227.0 * volume).epsilon(1e-10));
}

TEST_CASE("A surcharge adds a uniform stress to the initial one, and nothing moves",
          "[verification][fem]")
{
  FarFieldSpec spec = small_chamber();
  spec.surcharge = 2e6;
  FarField field(spec);
  const auto f = field.initial_interface_forces();
  // The region's weight and the surcharge on it rest on its floor.
  const double n_around = 8.0;
  const double weight =
      (1227.0 * 9.81 * 12e-3 + spec.surcharge) * half_polygon(5e-3, n_around);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : f) sum += force;
  CHECK(sum.z() == Approx(-weight).epsilon(1e-10));
  CHECK(std::abs(sum.x()) < 1e-12 * weight);

  field.solve_static(f);
  CHECK(field.unbalanced_ratio() < 1e-11); // of forces that cancel to the weight
  const double scale = spec.surcharge / spec.E * 40e-3;
  CHECK(field.motion().u.abs().maxCoeff() < 1e-10 * scale);
}

TEST_CASE("A chamber under side pressure has Lame's displacement, and its work is balanced",
          "[verification][fem]")
{
  // Timoshenko and Goodier, Theory of Elasticity, art. 28: a ring under the outer pressure p,
  // in plane stress far from the fixed base,
  //   u = -p b^2/(E (b^2 - a^2)) ((1 - nu) r + (1 + nu) a^2/r)
  FarFieldSpec spec = small_chamber();
  spec.cell_size = 1e-3;
  spec.growth = 1.2;
  spec.region_height = 30e-3; // six radii of the region
  spec.chamber_height = 60e-3;
  spec.gravity = spec.K0 = 0.0;
  spec.outer = FarFieldSpec::Outer::pressure;
  spec.side_pressure = 1e6;
  FarField field(spec);
  const InterfaceMesh& mesh = field.interface();
  field.solve_static(std::vector<Vec3>(mesh.x.size(), Vec3::Zero()));
  std::vector<Vec3> u;
  field.interface_displacement(u);
  const double a = 5e-3, b = 12.5e-3;
  const double exact = spec.side_pressure * b * b / (spec.E * (b * b - a * a)) *
                       ((1.0 - spec.nu) * a + (1.0 + spec.nu) * a);
  double worst = 0.0;
  int n = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Vec3& x = mesh.x[k];
    if (x.z() < -15e-3) continue; // three radii above the floor
    ++n;
    worst =
        std::max(worst, std::abs(-(u[k].x() * x.x() + u[k].y() * x.y()) / a / exact - 1.0));
  }
  CAPTURE(worst);
  CHECK(n > 100);
  CHECK(worst < 0.02);
}

TEST_CASE(
    "Pressure on the interface: damped steps end at the static solution, energy balanced",
    "[verification][fem]")
{
  FarFieldSpec spec = small_chamber();
  spec.chamber_height = 30e-3;
  FarField field(spec);
  const InterfaceMesh& mesh = field.interface();
  std::vector<Vec3> f = field.initial_interface_forces();
  for (const auto& t : mesh.triangles) {
    const Vec3 area =
        0.5 * (mesh.x[t[1]] - mesh.x[t[0]]).cross(mesh.x[t[2]] - mesh.x[t[0]]);
    for (const int a : t)
      f[static_cast<std::size_t>(a)] -= 1e6 / 3.0 * area; // out of the region
  }
  field.solve_static(f);
  const NodalField exact = field.motion().u;
  std::vector<Vec3> u;
  field.interface_displacement(u);
  double outwards = 0.0;
  for (std::size_t a = 0; a < u.size(); ++a) outwards += u[a].dot(mesh.x[a]);
  CHECK(outwards > 0.0);

  FarField moving(spec);
  const double dt = 0.7 * moving.stable_time_step() / std::sqrt(1.7);
  int steps = 0;
  for (; steps < 20000 && !(steps > 0 && moving.unbalanced_ratio() < 1e-10); ++steps)
    moving.step(dt, f);
  CHECK(steps < 20000);
  CHECK((moving.motion().u - exact).abs().maxCoeff() < 1e-6 * exact.abs().maxCoeff());

  const Energies e = moving.energies();
  const double unbalanced_energy = e.kinetic + e.strain - e.interface_work -
                                   e.gravity_work - e.initial_stress_work + e.damping;
  CHECK(std::abs(unbalanced_energy) < 1e-11 * e.interface_work);
  CHECK(e.damping > 0.0);
}

TEST_CASE("A symmetric load gives a whole far field the displacements of the half",
          "[verification][fem]")
{
  FarFieldSpec spec = small_chamber();
  const auto loaded = [&](Extent extent) {
    spec.extent = extent;
    FarField field(spec);
    const auto& x = field.interface().x;
    std::vector<Vec3> f = field.initial_interface_forces();
    // Outwards, 1 N in all at y > 0; the half has half of the load at its cut.
    for (std::size_t k = 0; k < x.size(); ++k) {
      const bool is_cut = x[k].y() == 0.0;
      const double share = extent == Extent::half && is_cut ? 0.5 : 1.0;
      f[k] += share * Vec3(x[k].x(), is_cut ? 0.0 : x[k].y(), 0.0) / spec.region_diameter;
    }
    field.solve_static(f);
    std::map<std::array<double, 3>, Vec3> u;
    std::vector<Vec3> values;
    field.interface_displacement(values);
    for (std::size_t k = 0; k < x.size(); ++k)
      u[{x[k].x() + 0.0, x[k].y() + 0.0, x[k].z()}] = values[k];
    return u;
  };
  const auto half = loaded(Extent::half), full = loaded(Extent::full);
  double largest = 0.0, difference = 0.0;
  for (const auto& [x, u] : half) {
    largest = std::max(largest, u.norm());
    const auto image = full.find({x[0], -x[1] + 0.0, x[2]});
    REQUIRE(image != full.end());
    difference = std::max({difference, (full.at(x) - u).norm(),
                           (image->second - Vec3(u.x(), -u.y(), u.z())).norm()});
  }
  CHECK(largest > 0.0);
  CHECK(difference < 1e-9 * largest); // both solved to a residual of 1e-12
}

namespace {

/// A chamber under its weight, held at the bottom, on rollers at its sides.
ElasticSolid held_chamber(const dealii::Triangulation<3>& mesh)
{
  return {mesh,
          {{1.1e9, 0.14}, 1227.0, Vec3(0.0, 0.0, -9.81), {}, {}},
          {{boundary::bottom, Support::fixed},
           {boundary::symmetry, Support::roller},
           {boundary::outer, Support::roller}}};
}

} // namespace

TEST_CASE("The static solution is that by Cholesky factors", "[verification][fem]")
{
  const FarFieldGeometry g{12.5e-3, 40e-3, 5e-3, 12e-3, 2e-3, 1.4};
  dealii::Triangulation<3> mesh;
  make_far_field_mesh(g, layers(g), mesh);
  const ElasticSolid solid = held_chamber(mesh);
  const auto& s = solid.discrete();
  const auto iterated = solve_static(s, s.f_gravity);
  const NodalField direct = test::solve_directly(s.K, s.f_gravity);
  // Both leave residuals of 1e-12 or less, measured difference 2e-14.
  CHECK((iterated.u - direct).abs().maxCoeff() < 1e-10 * direct.abs().maxCoeff());
  CHECK(iterated.iterations < 100); // measured 70
  CHECK(iterated.residual < 2e-12);

  // Without supports there is no static solution, and the solver throws.
  const ElasticSolid loose(mesh, {{1.1e9, 0.14}, 1227.0, Vec3(0.0, 0.0, -9.81), {}, {}},
                           {});
  CHECK_THROWS_AS(solve_static(loose.discrete(), loose.discrete().f_gravity),
                  std::runtime_error);
}

// PETSc 3.22, which solved it before, gave other bits at the second time: its vectors lay at
// other distances in memory.
TEST_CASE("The static solution has the same bits when it is repeated",
          "[verification][fem]")
{
  const FarFieldGeometry g{6e-3, 12e-3, 3e-3, 6e-3, 0.75e-3, 1.4};
  dealii::Triangulation<3> mesh;
  make_far_field_mesh(g, layers(g), mesh);
  const ElasticSolid solid = held_chamber(mesh);
  const auto& s = solid.discrete();
  const NodalField first = solve_static(s, s.f_gravity).u;
  for (std::size_t n = 1; n < 4; ++n) {
    const std::vector<double> in_between(1000 * n + 1, 1.0);
    const NodalField again = solve_static(s, s.f_gravity).u;
    CHECK(std::memcmp(first.data(), again.data(), sizeof(double) * 4 * s.n_nodes()) == 0);
  }
}
