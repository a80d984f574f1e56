// fem/membrane: one triangle and the nodal forces of a mesh (fem/README.md, Membrane).
#include "tests/support/membranes.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cstring>
#include <numbers>

using namespace mergel::fem;
using namespace mergel::fem::test;

namespace {

const MembraneMaterial latex{1.5e6, 0.3e-3, 1100.0, Compression::wrinkles};

MembraneMaterial latex_with(Compression compression)
{
  MembraneMaterial material = latex;
  material.compression = compression;
  return material;
}

/// A triangle of corners (0, 0), (a, 0), (0, b) at rest, stretched along these edges.
struct StretchedTriangle {
  static constexpr double a = 2e-3, b = 1e-3;
  double Px, Py; ///< nominal stress, from the forces on the corners [Pa]
  double tau_xy; ///< the same, of the shear [Pa]
  MembraneStretch<double, bool> stretch;

  StretchedTriangle(double lx, double ly, Compression compression)
      : stretch(MembraneStrain<double>(rest(), {lx * a, 0.0, 0.0}, {0.0, ly * b, 0.0})
                    .stretch(compression))
  {
    const auto f = corner_forces<double>(rest(), latex.mu(), compression, 0.0,
                                         {lx * a, 0.0, 0.0}, {0.0, ly * b, 0.0});
    // Half of the force on an edge acts on each of its corners.
    Px = -2.0 * f.at[1].x / (latex.thickness * b);
    Py = -2.0 * f.at[2].y / (latex.thickness * a);
    tau_xy = -2.0 * f.at[1].y / (latex.thickness * b);
  }
  static RestTriangle<double> rest()
  {
    return rest_triangle({a, 0.0, 0.0}, {0.0, b, 0.0}, latex.thickness);
  }
};

/// A sphere whose nodes, at rest and at x, lie at random within a fraction of their distance.
struct IrregularSphere {
  static constexpr double R = 0.025;
  dealii::Triangulation<2, 3> mesh;
  std::mt19937_64 random{7};

  explicit IrregularSphere(unsigned n)
  {
    make_sphere(R, n, mesh);
    std::uniform_real_distribution<double> u(-0.15, 0.15);
    const double h = R / (1u << n);
    std::vector<dealii::Point<3>> x = mesh.get_vertices();
    for (auto& vertex : x)
      for (unsigned c = 0; c < 3; ++c) vertex[c] += h * u(random);
    std::vector<dealii::CellData<2>> cells;
    for (const auto& cell : mesh.active_cell_iterators())
      cells.emplace_back(3).vertices = {cell->vertex_index(0), cell->vertex_index(1),
                                        cell->vertex_index(2)};
    mesh.clear();
    mesh.create_triangulation(x, cells, dealii::SubCellData());
  }
  /// Stretched by l1, l2, l3 along the axes, and each node by a tenth of its distance.
  NodalField deformed(const Membrane& membrane, const Vec3& stretch)
  {
    const double h = std::sqrt(4.0 * std::numbers::pi * R * R /
                               static_cast<double>(membrane.rest().triangles.size()));
    return moved(membrane.rest_positions(),
                 [&](const Vec3& x) { return x.cwiseProduct(stretch); }) +
           random_field(membrane.n_nodes(), 0.1 * h, random);
  }
};

constexpr Compression both_compressions[] = {Compression::wrinkles, Compression::carried};

} // namespace

// Treloar (1975), The Physics of Rubber Elasticity, ch. 4.
TEST_CASE("A membrane in a strip has the nominal stress mu (l - l^-2), stretched equally "
          "both ways mu (l - l^-5)",
          "[verification][fem]")
{
  const double mu = latex.mu();
  for (const double l : {1.001, 1.05, 1.3, 2.0, 5.0}) {
    CAPTURE(l);
    const double strip = mu * (l - 1.0 / (l * l)), free = 1.0 / std::sqrt(l);
    const StretchedTriangle carried(l, free, Compression::carried);
    // Round-off of stresses of the size mu l.
    CHECK(std::abs(carried.Px - strip) < 1e-14 * mu * l);
    CHECK(carried.Px == Approx(strip).epsilon(1e-12));
    CHECK(std::abs(carried.Py) < 1e-13 * mu * l);

    for (const Compression compression : both_compressions) {
      const StretchedTriangle equal(l, l, compression);
      CHECK(equal.Px == Approx(mu * (l - std::pow(l, -5.0))).epsilon(1e-12));
      CHECK(equal.Py == Approx(equal.Px).epsilon(1e-12));
      CHECK(equal.stretch.is_taut);
    }
  }
}

// Pipkin (1986), IMA J. Appl. Math. 36, 85.
TEST_CASE(
    "A membrane narrower than its strip wrinkles: the stress of the strip along, none "
    "across; below its length at rest it is slack and has none",
    "[verification][fem]")
{
  const double mu = latex.mu();
  for (const double l : {1.001, 1.05, 1.3, 2.0})
    for (const double across : {0.999, 0.7, 0.0}) { // of the width of the strip
      const StretchedTriangle t(l, across / std::sqrt(l), Compression::wrinkles);
      CAPTURE(l, across);
      CHECK_FALSE(t.stretch.is_taut);
      CHECK_FALSE(t.stretch.is_slack);
      CHECK(t.Px == Approx(mu * (l - 1.0 / (l * l))).epsilon(1e-12));
      CHECK(std::abs(t.Py) < 1e-14 * mu);
      CHECK(std::abs(t.tau_xy) < 1e-14 * mu);
    }
  const StretchedTriangle slack(0.999, 0.8, Compression::wrinkles);
  CHECK(slack.stretch.is_slack);
  CHECK((slack.Px == 0.0 && slack.Py == 0.0));
}

TEST_CASE("Nodal forces of a membrane are those of the weak form with deal.II's shape "
          "functions",
          "[verification][fem]")
{
  IrregularSphere sphere(2);
  const dealii::FE_SimplexP<2, 3> linear(1);
  const dealii::MappingFE<2, 3> mapping(linear);
  dealii::FEValues<2, 3> values(mapping, linear, dealii::QGaussSimplex<2>(1),
                                dealii::update_gradients | dealii::update_JxW_values |
                                    dealii::update_normal_vectors);
  for (const Compression compression : both_compressions) {
    const Membrane membrane(surface_of(sphere.mesh), latex_with(compression));
    const double mu = latex.mu(), p = 2e3;
    const NodalField x = sphere.deformed(membrane, Vec3(1.3, 0.9, 0.8));

    // f_a = -int P grad N_a dA t0, with P = F S and F = sum x_a grad N_a. F maps the tangent
    // plane; n n added to C makes it invertible and leaves its determinant.
    NodalField exact = NodalField::Zero(4, membrane.n_nodes());
    std::size_t n_wrinkled = 0;
    for (const auto& cell : sphere.mesh.active_cell_iterators()) {
      values.reinit(cell);
      const auto vec = [](const auto& t) { return Vec3(t[0], t[1], t[2]); };
      const Vec3 n = vec(values.normal_vector(0));
      const auto vertex = [&](unsigned a) {
        return static_cast<Eigen::Index>(cell->vertex_index(a));
      };
      Mat3 F = Mat3::Zero();
      for (unsigned a = 0; a < 3; ++a)
        F += at(x, vertex(a)) * vec(values.shape_grad(a, 0)).transpose();
      const Mat3 C = F.transpose() * F, closed = C + n * n.transpose();
      const Eigen::SelfAdjointEigenSolver<Mat3> eigen(C); // 0, l2^2, l1^2
      const double l1 = std::sqrt(eigen.eigenvalues()[2]),
                   l2 = std::sqrt(eigen.eigenvalues()[1]);
      const Vec3 N1 = eigen.eigenvectors().col(2);
      Mat3 S = mu * (Mat3::Identity() - Mat3(closed.inverse()) / closed.determinant());
      if (compression == Compression::wrinkles && l2 < 1.0 / std::sqrt(l1)) {
        S = l1 > 1.0 ? Mat3(mu * (1.0 - std::pow(l1, -3.0)) * N1 * N1.transpose())
                     : Mat3(Mat3::Zero());
        ++n_wrinkled;
      }
      const Vec3 area =
          0.5 *
          (at(x, vertex(1)) - at(x, vertex(0))).cross(at(x, vertex(2)) - at(x, vertex(0)));
      for (unsigned a = 0; a < 3; ++a)
        exact.col(vertex(a)).head<3>() +=
            (p / 3.0 * area -
             latex.thickness * values.JxW(0) * F * S * vec(values.shape_grad(a, 0)))
                .array();
    }
    NodalField f;
    Membrane(surface_of(sphere.mesh), latex_with(compression)).forces(x, p, f);
    const auto n_triangles = membrane.rest().triangles.size();
    if (compression == Compression::wrinkles) {
      CHECK(n_wrinkled > n_triangles / 5);
      CHECK(n_wrinkled < n_triangles);
      const MembraneFields fields = membrane.fields(x);
      CHECK(fields.n_wrinkled + fields.n_slack == n_wrinkled);
    }
    // Some hundred roundings of each number.
    CHECK((f - exact).abs().maxCoeff() < 1e-12 * exact.abs().maxCoeff());
  }
}

TEST_CASE("Forces of a membrane triangle in any lane have the bits of those in double",
          "[verification][fem]")
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto random_vector = [&] { return Vec3(u(random), u(random), u(random)); };
  const double p = 3e4;
  for (const Compression compression : both_compressions)
    for (int n = 0; n < 500; ++n) {
      RestTriangle<Lanes> rest{};
      Vector<Lanes> a{}, b{};
      RestTriangle<double> rest_of[n_lanes];
      Vector<double> a_of[n_lanes], b_of[n_lanes];
      for (int l = 0; l < n_lanes; ++l) {
        const Vec3 A = random_vector(), B = random_vector();
        // The first at rest and the second flat; the others at random.
        const Vec3 x = l == 0 ? A : Vec3(A + 0.7 * random_vector()),
                   y = l == 0   ? B
                       : l == 1 ? Vec3(1.5 * x)
                                : Vec3(B + 0.7 * random_vector());
        rest_of[l] = rest_triangle(A, B, 0.01);
        a_of[l] = {x.x(), x.y(), x.z()};
        b_of[l] = {y.x(), y.y(), y.z()};
        rest.i11[l] = rest_of[l].i11;
        rest.i12[l] = rest_of[l].i12;
        rest.i22[l] = rest_of[l].i22;
        rest.volume[l] = rest_of[l].volume;
        a.x[l] = x.x(), a.y[l] = x.y(), a.z[l] = x.z();
        b.x[l] = y.x(), b.y[l] = y.y(), b.z[l] = y.z();
      }
      const auto all = corner_forces(rest, latex.mu(), compression, p, a, b);
      for (int l = 0; l < n_lanes; ++l) {
        const auto one =
            corner_forces(rest_of[l], latex.mu(), compression, p, a_of[l], b_of[l]);
        for (int c = 0; c < 3; ++c) {
          const double lane[] = {all.at[c].x[l], all.at[c].y[l], all.at[c].z[l]},
                       alone[] = {one.at[c].x, one.at[c].y, one.at[c].z};
          REQUIRE(std::memcmp(lane, alone, sizeof lane) == 0);
          // A flat triangle that carries compression resists without limit.
          if (l != 1 || compression == Compression::wrinkles)
            REQUIRE((std::isfinite(alone[0]) && std::isfinite(alone[1])));
        }
      }
    }
}

TEST_CASE("Forces of a membrane are -dW/dx, without resultant or moment",
          "[verification][fem]")
{
  IrregularSphere sphere(1);
  for (const Compression compression : both_compressions) {
    Membrane membrane(surface_of(sphere.mesh), latex_with(compression));
    const NodalField x = sphere.deformed(membrane, Vec3(1.2, 1.0, 0.8));
    NodalField f;
    membrane.forces(x, 0.0, f);
    const double size = f.matrix().norm(), h = 1e-5 * sphere.R;
    for (Eigen::Index a = 0; a < membrane.n_nodes(); ++a)
      for (int c = 0; c < 3; ++c) {
        NodalField more = x, less = x;
        more(c, a) += h;
        less(c, a) -= h;
        const double slope =
            (membrane.strain_energy(more) - membrane.strain_energy(less)) / (2.0 * h);
        // (h over the node distance)^2 = 1e-9, and less than h where a triangle turns from
        // taut to wrinkled.
        CHECK(std::abs(f(c, a) + slope) < 1e-6 * size);
      }
    CHECK(f.row(3).isZero(0.0));
    CHECK(resultant(f).norm() < 1e-14 * size);
    CHECK(moment(x, f).norm() < 1e-14 * size * sphere.R);
  }
}

TEST_CASE(
    "A membrane that is turned and shifted has the forces turned with it, none at rest",
    "[verification][fem]")
{
  IrregularSphere sphere(2);
  const Mat3 turn =
      Eigen::AngleAxisd(2.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const Vec3 shift(0.04, -0.02, 0.07);
  const auto rigid = [&](const Vec3& x) { return Vec3(turn * x + shift); };
  for (const Compression compression : both_compressions) {
    Membrane membrane(surface_of(sphere.mesh), latex_with(compression));
    NodalField f, g;
    const NodalField rest = membrane.rest_positions();
    // A position is rounded by 1e-16 of 0.1 m.
    const double round_off = 1e-17 * membrane.stiffness_bound(rest).maxCoeff();
    membrane.forces(rest, 0.0, f);
    CHECK(f.abs().maxCoeff() < round_off);
    membrane.forces(moved(rest, rigid), 0.0, f);
    CHECK(f.abs().maxCoeff() < 10.0 * round_off);
    CHECK(membrane.strain_energy(moved(rest, rigid)) <
          1e-13 * latex.E * latex.thickness * sphere.R * sphere.R);

    const NodalField x = sphere.deformed(membrane, Vec3(1.2, 1.0, 0.8));
    membrane.forces(x, 2e3, f);
    membrane.forces(moved(x, rigid), 2e3, g);
    const NodalField turned = moved(f, [&](const Vec3& a) { return Vec3(turn * a); });
    CHECK((g - turned).abs().maxCoeff() < 1e-12 * f.abs().maxCoeff());
  }
}

TEST_CASE(
    "Pressure on a closed membrane has no resultant and no moment, and its forces are "
    "p dV/dx",
    "[verification][fem]")
{
  IrregularSphere sphere(2);
  Membrane membrane(surface_of(sphere.mesh), latex);
  // Slack everywhere: the pressure alone.
  const NodalField x =
      sphere.deformed(membrane, Vec3(0.5, 0.4, 0.3)) +
      moved(membrane.rest_positions(), [](const Vec3&) { return Vec3(0.01, 0.02, -0.03); });
  REQUIRE(membrane.fields(x).n_slack == membrane.rest().triangles.size());
  const double p = 3e5;
  NodalField f;
  membrane.forces(x, p, f);
  const double size = f.matrix().colwise().norm().sum();
  CHECK(resultant(f).norm() < 1e-14 * size);
  CHECK(moment(x, f).norm() < 1e-14 * size * sphere.R);

  // V is cubic: (V(x + d) - V(x - d))/2 = dV/dx.d + V(d), exactly, for any d.
  for (int n = 0; n < 10; ++n) {
    const NodalField d = random_field(membrane.n_nodes(), 0.3 * sphere.R, sphere.random);
    const double dV =
        0.5 * (volume(membrane.rest(), x + d) - volume(membrane.rest(), x - d)) -
        volume(membrane.rest(), d);
    CHECK(dot(f, d) == Approx(p * dV).epsilon(1e-12));
  }
}

TEST_CASE("The stiffness bound of a membrane is never exceeded, and at most ten times the "
          "largest ratio",
          "[verification][fem]")
{
  IrregularSphere sphere(1);
  const Vec3 stretches[] = {Vec3(1.0, 1.0, 1.0), Vec3(1.5, 1.4, 1.3), Vec3(1.2, 1.0, 0.7)};
  for (const Compression compression : both_compressions)
    for (const Vec3& stretch : stretches) {
      Membrane membrane(surface_of(sphere.mesh), latex_with(compression));
      const bool at_rest = stretch == Vec3(1.0, 1.0, 1.0);
      const NodalField x =
          at_rest ? membrane.rest_positions() : sphere.deformed(membrane, stretch);
      const Eigen::ArrayXd k = membrane.stiffness_bound(x);
      const auto times_K = [&](const NodalField& u) {
        NodalField more, less;
        const double h = 1e-6 * sphere.R / u.abs().maxCoeff();
        membrane.forces(x + h * u, 0.0, more);
        membrane.forces(x - h * u, 0.0, less);
        return NodalField((less - more) / (2.0 * h));
      };
      const auto ratio = [&](const NodalField& u, const NodalField& Ku) {
        return dot(u, Ku) / (u.square().colwise().sum() * k.transpose()).sum();
      };
      double worst = 0.0;
      for (int n = 0; n < 20; ++n) {
        NodalField u = random_field(membrane.n_nodes(), 1.0, sphere.random);
        worst = std::max(worst, ratio(u, times_K(u)));
      }
      // Power iteration leads to the largest ratio.
      NodalField u = random_field(membrane.n_nodes(), 1.0, sphere.random);
      for (int n = 0; n < 200; ++n) {
        const NodalField Ku = times_K(u);
        worst = std::max(worst, ratio(u, Ku));
        u = Ku.rowwise() / k.transpose();
        u /= u.abs().maxCoeff();
      }
      CAPTURE(static_cast<int>(compression), stretch.transpose(), worst);
      CHECK(worst <= 1.0);
      CHECK(worst > 0.1);
    }
}

TEST_CASE("Forces of a membrane that ranks share have the bits of those of one",
          "[verification][fem]")
{
  IrregularSphere sphere(2);
  for (const Compression compression : both_compressions) {
    Membrane alone(surface_of(sphere.mesh), latex_with(compression));
    const NodalField x = sphere.deformed(alone, Vec3(1.2, 1.0, 0.8));
    NodalField f, f_shared;
    alone.forces(x, 1e3, f);
    for (const MPI_Comm comm : {MPI_COMM_SELF, MPI_COMM_WORLD}) {
      Membrane shared(surface_of(sphere.mesh), latex_with(compression), comm);
      shared.forces(x, 1e3, f_shared);
      CHECK((f == f_shared).all());
    }
  }
}
