#include "dem/assembly/local_strain.h"
#include "dem/assembly/neighbourhood.h"
#include "dem/io/assembly_fields.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3;

// Positions are exact to 1e-16 of some ten radii, so F to a few 1e-15; 1e-14 where the
// neighbours nearly lie in a plane.
constexpr double round_off = 1e-12;

/// n^3 places of a cubic lattice of spacing 2 R, each moved by up to 0.3 R along each axis.
std::vector<Vec3> disordered(int n)
{
  std::mt19937_64 random(7);
  std::vector<Vec3> X;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c)
        X.push_back(2.0 * R * Vec3(a, b, c) + 0.3 * R * random_vector(random));
  return X;
}

std::vector<double> radii(const std::vector<Vec3>& X)
{
  return std::vector<double>(X.size(), R);
}

/// x = F X + c, with some c.
std::vector<Vec3> moved(const Mat3& F, const std::vector<Vec3>& X)
{
  std::vector<Vec3> x;
  for (const Vec3& at : X) x.push_back(F * at + Vec3(3.0, -2.0, 1.0) * R);
  return x;
}

Mat3 rotation(double degrees)
{
  const Vec3 axis = Vec3(1.0, -2.0, 3.0).normalized();
  return Eigen::AngleAxisd(degrees * pi / 180.0, axis).toRotationMatrix();
}

Mat3 simple_shear(double gamma)
{
  Mat3 F = Mat3::Identity();
  F(0, 2) = gamma;
  return F;
}

/// A particle at the origin and six neighbours at the distance a along the axes, too far
/// from each other to be neighbours; the first is at a e_x.
constexpr double a = 2.4 * R;
std::vector<Vec3> octahedron()
{
  std::vector<Vec3> X{Vec3::Zero()};
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) X.push_back(sign * a * Vec3::Unit(k));
  return X;
}

bool is_undetermined(const DeformationFit& fit)
{
  return fit.F == Mat3::Identity() && fit.D2_min == 0.0 && fit.n == 0;
}

std::vector<Index> all(const std::vector<Vec3>& X)
{
  std::vector<Index> indices(X.size());
  std::iota(indices.begin(), indices.end(), Index{0});
  return indices;
}

} // namespace

TEST_CASE(
    "Every particle of an affine motion has its gradient, shear and rotation included",
    "[unit][dem]")
{
  const Mat3 F = rotation(25.0) * simple_shear(0.3) * Vec3(0.9, 1.05, 1.1).asDiagonal();
  const std::vector<Vec3> X = disordered(6), x = moved(F, X);
  double error = 0.0, D2_min = 0.0;
  std::size_t fewest = X.size();
  for (const DeformationFit& fit : local_deformations(X, x, radii(X))) {
    error = std::max(error, (fit.F - F).norm());
    D2_min = std::max(D2_min, fit.D2_min);
    fewest = std::min(fewest, fit.n);
  }
  CHECK(error < round_off);
  CHECK(D2_min < round_off * round_off);
  CHECK(fewest >= 4); // at the corners too

  const DeformationFit fit = deformation_of(X, x, all(X));
  CHECK((fit.F - F).norm() < round_off);
  CHECK(fit.D2_min < round_off * round_off);
  CHECK(fit.n == X.size());
}

TEST_CASE("A rigid turn by 40 degrees leaves no strain", "[unit][dem]")
{
  const std::vector<Vec3> X = disordered(4), x = moved(rotation(40.0), X);
  double volumetric = 0.0, shear = 0.0, D2_min = 0.0;
  for (const DeformationFit& fit : local_deformations(X, x, radii(X))) {
    REQUIRE(fit.n > 0);
    volumetric = std::max(volumetric, std::abs(volumetric_strain(fit.F)));
    shear = std::max(shear, shear_strain(fit.F));
    D2_min = std::max(D2_min, fit.D2_min);
  }
  CHECK(volumetric < round_off);
  CHECK(shear < round_off);
  CHECK(D2_min < round_off * round_off);
}

TEST_CASE("Volumetric strain is positive in compression, and shear strain has the closed "
          "forms of simple shear and uniaxial strain",
          "[unit][dem]")
{
  CHECK(volumetric_strain(0.99 * Mat3::Identity()) == Approx(1.0 - 0.99 * 0.99 * 0.99));
  CHECK(shear_strain(0.99 * Mat3::Identity()) == Approx(0.0).margin(1e-15));

  // E_xz = gamma/2, E_zz = gamma^2/2.
  const double gamma = 0.4;
  CHECK(volumetric_strain(simple_shear(gamma)) == Approx(0.0).margin(1e-15));
  CHECK(shear_strain(simple_shear(gamma)) ==
        Approx(std::sqrt(gamma * gamma / 3.0 + std::pow(gamma, 4) / 9.0)));

  Mat3 F = Mat3::Identity();
  F(2, 2) = 0.8; // E_zz = -0.18
  CHECK(volumetric_strain(F) == Approx(0.2));
  CHECK(shear_strain(F) == Approx(2.0 / 3.0 * 0.18));
  CHECK(shear_strain(rotation(70.0) * F) == Approx(2.0 / 3.0 * 0.18));
}

TEST_CASE("One displaced neighbour of six gives the F and D2_min of the closed form",
          "[unit][dem]")
{
  // sum D D^T = 2 a^2 I, so F = I + delta (x) e_x/(2 a). The pair along x takes half of
  // delta each: delta^2/2 remains of 6 a^2.
  const std::vector<Vec3> X = octahedron();
  std::vector<Vec3> x = X;
  const Vec3 delta = Vec3(0.1, -0.2, 0.3) * R;
  x[1] += delta;
  const DeformationFit fit = local_deformations(X, x, radii(X))[0];
  const Mat3 F = Mat3::Identity() + delta * Vec3::UnitX().transpose() / (2.0 * a);
  CHECK(fit.n == 6);
  CHECK((fit.F - F).norm() < round_off);
  CHECK(fit.D2_min == Approx(delta.squaredNorm() / (12.0 * a * a)).epsilon(round_off));
}

TEST_CASE("D2_min does not depend on the unit of length", "[unit][dem]")
{
  std::vector<Vec3> X = octahedron(), x = X;
  x[1] += Vec3(0.1, -0.2, 0.3) * R;
  const double D2_min = deformation_of(X, x, all(X)).D2_min;
  CHECK(D2_min > 0.0);
  for (auto* positions : {&X, &x})
    for (Vec3& at : *positions) at *= 1000.0;
  CHECK(deformation_of(X, x, all(X)).D2_min == Approx(D2_min).epsilon(round_off));
}

TEST_CASE("A set is fitted about its centroid by its own particles alone", "[unit][dem]")
{
  const std::vector<Vec3> X = disordered(4);
  std::vector<Vec3> x = moved(simple_shear(0.1), X);
  std::vector<Index> set;
  for (Index i = 0; i < X.size(); ++i)
    if (i % 3 == 0)
      set.push_back(i);
    else
      x[i] += Vec3(5.0, 5.0, 5.0) * R;
  const DeformationFit fit = deformation_of(X, x, set);
  CHECK((fit.F - simple_shear(0.1)).norm() < round_off);
  CHECK(fit.n == set.size());
}

TEST_CASE("An isolated particle, and one with neighbours in a plane, get the identity",
          "[unit][dem]")
{
  std::vector<Vec3> X{Vec3(100.0, 0.0, 0.0) * R}; // isolated
  for (int k = 0; k < 5; ++k)
    for (int l = 0; l < 5; ++l) X.push_back(2.0 * R * Vec3(k, l, 0.0));
  const Mat3 F = rotation(30.0) * simple_shear(0.2);
  for (const DeformationFit& fit : local_deformations(X, moved(F, X), radii(X)))
    CHECK(is_undetermined(fit));

  X[1].z() = 1e-3 * R; // one corner leaves the plane, too little
  CHECK(is_undetermined(local_deformations(X, moved(F, X), radii(X))[2]));
  X[1].z() = 0.1 * R;
  const auto fits = local_deformations(X, moved(F, X), radii(X));
  CHECK(is_undetermined(fits[1])); // three neighbours
  CHECK(fits[2].n == 5);
  CHECK((fits[2].F - F).norm() < round_off);
  CHECK(is_undetermined(fits[13])); // the corner is not among its neighbours

  CHECK(is_undetermined(deformation_of(X, X, {})));
  CHECK(is_undetermined(deformation_of(X, X, {1, 2, 3})));
  CHECK(is_undetermined(deformation_of(X, X, {2, 3, 4, 7, 8})));
  CHECK_FALSE(is_undetermined(deformation_of(X, X, {1, 2, 3, 7, 8})));
  CHECK(local_deformations({}, std::vector<Vec3>{}, {}).empty());
}

TEST_CASE("Neighbours are those within 1.5 (R_i + R_j) of the reference, however far they "
          "are now",
          "[unit][dem]")
{
  std::vector<Vec3> X = octahedron();
  std::vector<double> r = radii(X);
  r[1] = 0.5 * R;
  X[1] = Vec3(1.499 * 1.5 * R, 0.0, 0.0);
  std::vector<Vec3> x = X;
  x[2].x() = -50.0 * R;
  CHECK(local_deformations(X, x, r)[0].n == 6);
  X[1].x() = 1.501 * 1.5 * R;
  CHECK(local_deformations(X, X, r)[0].n == 5);
}

TEST_CASE("In a strained periodic cell every particle has the strain of the cell",
          "[unit][dem]")
{
  const std::vector<Vec3> X = disordered(4);
  const Mat3 F = Vec3(0.9, 1.02, 0.95).asDiagonal();
  const PeriodicCell cell_0{Vec3::Constant(8.0 * R)}, cell{F * cell_0.size};
  double error = 0.0;
  std::size_t fewest = X.size();
  for (const auto& fit : local_deformations(X, moved(F, X), radii(X), cell_0, cell)) {
    error = std::max(error, (fit.F - F).norm());
    fewest = std::min(fewest, fit.n);
  }
  CHECK(error < round_off);
  CHECK(fewest >= 8); // the regular lattice has 18 within 3 R

  const PeriodicCell narrow{Vec3::Constant(5.99 * R)};
  CHECK_THROWS_AS(local_deformations(X, X, radii(X), narrow, narrow), mergel::InputError);
}

TEST_CASE(
    "Strains and velocity gradients of the owned particles are those of all, bit by bit",
    "[unit][dem]")
{
  const std::vector<Vec3> X = disordered(6);
  std::mt19937_64 random(8);
  Particles all;
  for (const Vec3& at : X) {
    all.add(sphere(at + 0.1 * R * random_vector(random), R));
    all.state.back().v = random_vector(random);
  }
  const auto fits = local_deformations(X, all);
  const auto gradients = velocity_gradients(all, {}, held_neighbours(all));
  REQUIRE(fits.size() == X.size());
  Particles half = all;
  std::vector<char> is_owned(X.size(), 0);
  for (Index i = 0; i < X.size(); ++i) is_owned[i] = X[i].x() < 5.0 * R && i % 5 != 2;
  half.set_ownership(is_owned, std::vector<char>(X.size(), 0));
  const auto fits_of_half = local_deformations(X, half);
  const auto gradients_of_half = velocity_gradients(half, {}, held_neighbours(half));
  REQUIRE(fits_of_half.size() == half.n_owned());
  REQUIRE(gradients_of_half.size() == half.n_owned());
  std::size_t k = 0;
  half.for_owned([&](Index i) {
    REQUIRE(fits[i].n > 0);
    REQUIRE((fits_of_half[k].F == fits[i].F));
    REQUIRE(fits_of_half[k].D2_min == fits[i].D2_min);
    REQUIRE((gradients_of_half[k] == gradients[i]));
    ++k;
  });
  CHECK(k > 50);
}

TEST_CASE("The velocity gradient of an affine motion is found by every particle",
          "[unit][dem]")
{
  const std::vector<Vec3> x = disordered(4);
  Mat3 L;
  L << 3.0, -1.0, 0.5, 2.0, -4.0, 0.0, 1.0, 0.3, 2.0; // [1/s]
  for (const Mat3& found : velocity_gradients(x, moved(L, x), radii(x)))
    REQUIRE((found - L).norm() < round_off * L.norm());
  const std::vector<Vec3> three(x.begin(), x.begin() + 3); // too few to determine it
  for (const Mat3& found : velocity_gradients(three, moved(L, three), radii(three)))
    CHECK(found == Mat3::Zero());
  CHECK_THROWS_AS(velocity_gradients(x, {}, radii(x)), std::logic_error);
}

TEST_CASE("Particles at rest in a cell have its rate, in a narrow one too", "[unit][dem]")
{
  const std::vector<Vec3> x = disordered(4);
  const std::vector<Vec3> v(x.size(), Vec3::Zero()); // relative to the cell
  PeriodicCell cell{Vec3::Constant(8.0 * R)};
  cell.rate = {0.1, 0.2, -0.4};
  const Mat3 rate = cell.rate.asDiagonal();
  for (const double edge : {8.0 * R, 5.99 * R}) {
    cell.size = Vec3::Constant(edge);
    for (const Mat3& found : velocity_gradients(x, v, radii(x), cell))
      REQUIRE((found - rate).norm() == 0.0);
  }
}

TEST_CASE("Positions and radii of different number are refused", "[unit][dem]")
{
  const std::vector<Vec3> X = octahedron();
  CHECK_THROWS_AS(local_deformations(X, {}, radii(X)), std::logic_error);
  CHECK_THROWS_AS(local_deformations(X, X, {R}), std::logic_error);
  CHECK_THROWS_AS(deformation_of(X, X, {7}), std::out_of_range);
}

TEST_CASE("The strain fields have one finite number a particle", "[unit][dem]")
{
  const Mat3 F = simple_shear(0.1);
  const auto fields = strain_fields({{F, 0.25, 6}, {}});
  REQUIRE(fields.size() == 3);
  CHECK(fields[0].name == "volumetric strain [-]");
  CHECK(fields[1].name == "shear strain [-]");
  CHECK(fields[2].name == "D2_min [-]");
  for (const Field& field : fields) CHECK(field.components == 1);
  CHECK(fields[0].values == std::vector<double>{volumetric_strain(F), 0.0});
  CHECK(fields[1].values == std::vector<double>{shear_strain(F), 0.0});
  CHECK(fields[2].values == std::vector<double>{0.25, 0.0});
}
