// The static equations of fem/ against closed forms: fem/README.md, 1. Equations,
// 3. Boundary conditions, 8. Static solution.
#include "tests/support/catch.h"

#include "tests/verification/fem_solids.h"

#include "fem/solver/linear_solver.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace mergel::fem;
using namespace mergel::fem::test;

namespace {

// A cube whose inner nodes are moved at random, so that no cell is a box.
void make_distorted_cube(dealii::Triangulation<3>& mesh)
{
  make_box({1.0, 1.0, 1.0}, {3, 3, 3}, mesh);
  dealii::GridTools::distort_random(0.2, mesh, true);
}

const SolidProperties rock{{1.1e9, 0.14}, 1227.0, Vec3::Zero(), {}, {}};

double largest(const NodalField& field)
{
  return field.abs().maxCoeff();
}

} // namespace

// Irons & Razzaque (1972): an element that passes converges.
TEST_CASE(
    "Patch test: a linear displacement of the boundary gives the exact constant stress",
    "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_distorted_cube(mesh);
  const ElasticSolid free(mesh, rock, {});
  Supports all_fixed;
  for (const Side side : {x_low, x_high, y_low, y_high, z_low, z_high})
    all_fixed[side] = Support::fixed;
  const ElasticSolid held(mesh, rock, all_fixed);

  Mat3 gradient;
  gradient << 1.0, 0.3, -0.2, 0.5, -0.7, 0.4, 0.1, 0.6, 0.2;
  gradient *= 1e-3;
  const NodalField linear = sample(free, [&](const Vec3& x) { return Vec3(gradient * x); });

  // u = boundary values + w, where w vanishes on the boundary
  NodalField u = linear;
  for (std::size_t a = 0; a < held.discrete().n_nodes(); ++a)
    if (!held.discrete().P[a].isZero()) u.col(static_cast<Eigen::Index>(a)).setZero();
  NodalField Ku;
  free.discrete().K.multiply(u, Ku);
  for (std::uint32_t a = 0; a < held.discrete().n_nodes(); ++a)
    Ku.col(a).head<3>() = (held.discrete().P[a] * at(Ku, a)).array();
  u -= solve_directly(held.discrete().K, Ku);
  // Measured 3e-16 of the largest displacement.
  CHECK(largest(u - linear) < 1e-12 * largest(linear));

  const Mat3 eps = 0.5 * (gradient + gradient.transpose());
  const Mat3 sigma =
      rock.elastic.lambda() * eps.trace() * Mat3::Identity() + 2.0 * rock.elastic.G() * eps;
  for (const auto& stress : free.cell_stress(u))
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        CHECK(stress[i][j] == Approx(sigma(i, j)).margin(1e-11 * sigma.norm()));
}

TEST_CASE("A rigid translation and a small rigid rotation of a free solid cause no force",
          "[verification][fem]")
{
  dealii::Triangulation<3> mesh;
  make_distorted_cube(mesh);
  const ElasticSolid solid(mesh, rock, {});
  const auto& K = solid.discrete().K;
  NodalField Ku;
  // Force of a strained state of the same size, for scale.
  K.multiply(sample(solid, [](const Vec3& x) { return Vec3(x.x() * x.x(), 0.0, 0.0); }),
             Ku);
  const double scale = largest(Ku);

  K.multiply(sample(solid, [](const Vec3&) { return Vec3(1.0, -2.0, 0.5); }), Ku);
  CHECK(largest(Ku) < 1e-13 * scale);
  const Vec3 spin(0.3, -1.0, 0.7);
  K.multiply(sample(solid, [&](const Vec3& x) { return Vec3(spin.cross(x)); }), Ku);
  CHECK(largest(Ku) < 1e-13 * scale);
}

TEST_CASE("A rod with nu = 0 under an end load F stretches by F L/(E A)",
          "[verification][fem]")
{
  const double L = 1.0, side = 0.1, F = 1000.0;
  dealii::Triangulation<3> mesh;
  make_box({L, side, side}, {10, 2, 2}, mesh);
  const double E = 1.1e9;
  const ElasticSolid rod(mesh, {{E, 0.0}, 1227.0, Vec3::Zero(), {}, {}},
                         {{x_low, Support::fixed}});
  const NodalField f = traction_forces(
      rod, x_high, [&](const Vec3&, const Vec3& n) { return Vec3(F / (side * side) * n); });
  const NodalField u = solve_static(rod.discrete(), f).u;
  for (const auto a : rod.nodes_on(x_high))
    CHECK(u(0, a) ==
          Approx(F * L / (E * side * side)).epsilon(1e-9)); // solver tolerance 1e-12
}

// Lame (1852); Timoshenko & Goodier, Theory of Elasticity, art. 28, plane strain.
TEST_CASE("Lame's thick cylinder under inner pressure converges at second order",
          "[verification][fem]")
{
  using std::numbers::pi;
  const double a = 1.0, b = 2.0, p = 1e6;
  const Elastic e{1.1e9, 0.3};
  const double exact = p * a * (1.0 + e.nu) / e.E * ((1.0 - 2.0 * e.nu) * a * a + b * b) /
                       (b * b - a * a); // u_r(a)

  const auto error = [&](unsigned int n) {
    dealii::Triangulation<3> mesh;
    make_box({1.0, 1.0, 0.1}, {n, 2 * n, 1}, mesh); // radius, angle, axis
    dealii::GridTools::transform(
        [&](const dealii::Point<3>& x) {
          const double r = a + x[0] * (b - a), theta = x[1] * pi / 2.0;
          return dealii::Point<3>(r * std::cos(theta), r * std::sin(theta), x[2]);
        },
        mesh);
    const ElasticSolid ring(mesh, {e, 1.0, Vec3::Zero(), {}, {}},
                            {{y_low, Support::roller},
                             {y_high, Support::roller},
                             {z_low, Support::roller},
                             {z_high, Support::roller}});
    const NodalField f = traction_forces(
        ring, x_low, [&](const Vec3&, const Vec3& n) { return Vec3(-p * n); });
    const NodalField u = solve_static(ring.discrete(), f).u;
    double worst = 0.0;
    for (const auto node : ring.nodes_on(x_low))
      worst = std::max(worst, std::abs(at(u, node).norm() / exact - 1.0));
    return worst;
  };
  const double coarse = error(6), fine = error(12);
  // Measured: order 1.98, error 1.5e-3 with 12 cells across the wall.
  CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.1));
  CHECK(fine < 2e-3);
}

TEST_CASE("Pressures on the surface are in equilibrium with their uniform stress",
          "[verification][fem]")
{
  // sigma = -diag(p_x, p_y, p_z) without support of its sides: two supports per axis at most.
  const Elastic e{1.1e9, 0.3};
  const double p_x = 2e6, p_z = 5e6;
  dealii::Triangulation<3> mesh;
  make_box({1.0, 2.0, 3.0}, {2, 3, 4}, mesh);
  const ElasticSolid box(
      mesh, {e, 1.0, Vec3::Zero(), {}, {{x_high, p_x}, {z_high, p_z}}},
      {{x_low, Support::roller}, {y_low, Support::roller}, {z_low, Support::roller}});
  const NodalField u = solve_static(box.discrete(), -box.discrete().f_initial).u;
  const Vec3 strain = Vec3(-p_x + e.nu * p_z, e.nu * (p_x + p_z), -p_z + e.nu * p_x) / e.E;
  for (const auto a : all_nodes(box)) // solver tolerance 1e-12
    CHECK((at(u, a) - box.discrete().x[a].cwiseProduct(strain)).norm() <
          1e-9 * 3.0 * strain.norm());
}

TEST_CASE("A column that settles between rollers has sigma_h = nu/(1-nu) sigma_v",
          "[verification][fem]")
{
  const double H = 2.0, g = 9.81, nu = 0.3, rho = 1227.0;
  dealii::Triangulation<3> mesh;
  make_box({0.3, 0.3, H}, {2, 2, 8}, mesh);
  const ElasticSolid column(mesh, {{1.1e9, nu}, rho, Vec3(0.0, 0.0, -g), {}, {}},
                            {{x_low, Support::roller},
                             {x_high, Support::roller},
                             {y_low, Support::roller},
                             {y_high, Support::roller},
                             {z_low, Support::fixed}});
  const auto& s = column.discrete();
  CHECK(s.f_gravity.row(2).sum() == Approx(-rho * g * 0.3 * 0.3 * H * (1.0 - 1.0 / 16.0)));

  const auto stress = column.cell_stress(solve_static(s, s.f_gravity).u);
  for (const auto& cell : mesh.active_cell_iterators()) {
    const auto& sigma = stress[cell->active_cell_index()];
    const double sigma_v = -rho * g * (H - cell->center()[2]);
    // One-dimensional linear elements are exact at the nodes, so the cell mean is exact.
    CHECK(sigma[2][2] == Approx(sigma_v).epsilon(1e-9));
    CHECK(sigma[0][0] == Approx(nu / (1.0 - nu) * sigma_v).epsilon(1e-9));
    CHECK(std::abs(sigma[0][1]) + std::abs(sigma[0][2]) < 1e-9 * std::abs(sigma_v));
  }
}

TEST_CASE("A curved roller holds the radius and lets the solid rotate",
          "[verification][fem]")
{
  using std::numbers::pi;
  dealii::Triangulation<3> mesh;
  make_box({1.0, 1.0, 0.5}, {3, 12, 2}, mesh);
  dealii::GridTools::transform(
      [&](const dealii::Point<3>& x) {
        const double r = 1.0 + x[0], theta = (0.1 + 0.8 * x[1]) * pi;
        return dealii::Point<3>(r * std::cos(theta), r * std::sin(theta), x[2]);
      },
      mesh);
  const ElasticSolid arc(mesh, rock, {{x_high, Support::roller}});
  const auto& s = arc.discrete();
  REQUIRE(!s.oblique.empty());

  const NodalField turn =
      sample(arc, [](const Vec3& x) { return Vec3(-x.y(), x.x(), 0.0); });
  const NodalField swell =
      sample(arc, [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.0); });
  NodalField Ku;
  s.K.multiply(swell, Ku);
  const double scale = largest(Ku);
  s.K.multiply(turn, Ku);
  const double length = 2.0 * 0.8 * pi / 12.0; // of a face
  for (const auto a : arc.nodes_on(x_high)) {
    const Vec3 radial = (s.P[a] * Vec3(s.x[a].x(), s.x[a].y(), 0.0));
    const bool is_at_end = s.x[a].y() < 2.0 * std::sin(0.1 * pi) + 1e-9;
    // At an end of the arc only one face counts: its normal is off by half a face's angle,
    // measured 0.209, the sine of which times the radius is half a face.
    CHECK(radial.norm() < (is_at_end ? 0.6 * length : 1e-12));
    CHECK(s.P[a].trace() == Approx(2.0));
  }
  // Rotation causes forces at the ends alone: measured 4 % of those of swelling there,
  // round-off elsewhere.
  for (std::uint32_t a = 0; a < s.n_nodes(); ++a) {
    const double angle = std::atan2(s.x[a].y(), s.x[a].x());
    if (angle > 0.3 * pi && angle < 0.7 * pi) CHECK(at(Ku, a).norm() < 1e-12 * scale);
  }
}
