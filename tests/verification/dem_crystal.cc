#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <array>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 0.03, d = 2.0 * R;

void set_kappa(Scene& s, double kappa)
{
  section(s.material.bond).kappa = kappa;
}

/// One particle of a crystal and the neighbours to which it is bonded.
struct Lattice {
  std::vector<Vec3> branches; ///< from the particle to its neighbours, unit
  double volume;              ///< of the cell of one particle [m^3]
};

/// Twelve neighbours; cell edge a = sqrt(2) d, four particles per cell.
Lattice face_centred()
{
  Lattice l{{}, std::pow(std::sqrt(2.0) * d, 3) / 4.0};
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      for (const Vec3& v : {Vec3(a, b, 0.0), Vec3(b, 0.0, a), Vec3(0.0, a, b)})
        l.branches.push_back(v.normalized());
  return l;
}

Lattice simple_cubic()
{
  Lattice l{{}, d * d * d};
  for (const double a : {-1.0, 1.0})
    for (int axis = 0; axis < 3; ++axis) l.branches.push_back(a * Vec3::Unit(axis));
  return l;
}

/// A crystal under a small strain.
struct Crystal {
  Lattice lattice;
  double kappa; ///< of the bonds
  Mat3 turn;    ///< rotation of the crystal in space
  int n_steps;  ///< in which it is strained

  struct Stiffness {
    double k_n, k_s;
  };
  Stiffness stiffness() const
  {
    const auto bond = unbreakable_bond();
    const double R_b = bond.lambda_b * R, k_n = bond.E * pi * R_b * R_b / d;
    return {k_n, k_n / kappa};
  }

  /// Stress per strain, tension positive, in the axes of the crystal.
  ///
  /// The neighbours move as x = (1 + eps) X, without spin. Love and Weber, each branch
  /// shared by two cells: sigma = 1/(2 V) sum f (x) r with f the force on the particle.
  Mat3 stress(const Mat3& direction, double strain) const
  {
    Scene s;
    s.material.bond = unbreakable_bond();
    set_kappa(s, kappa);
    s.p.add(sphere(Vec3::Zero(), R));
    std::vector<Pair> pairs;
    for (const Vec3& n : lattice.branches)
      pairs.push_back({0, s.p.add(sphere(turn * n * d, R))});
    s.bond(pairs);
    const double dt = 1e-5;
    const Mat3 rate = turn * direction * turn.transpose() * (strain / (n_steps * dt));
    for (ParticleState& b : s.p.state) b.v = rate * b.x;
    for (int k = 0; k < n_steps; ++k) {
      drift(s.p, dt);
      s.forces(dt);
    }
    Mat3 sigma = Mat3::Zero();
    for (std::size_t j = 1; j < s.p.size(); ++j)
      sigma -= s.p.load[j].f * s.p.state[j].x.transpose() / (2.0 * lattice.volume);
    return turn.transpose() * sigma * turn / strain;
  }
};

Mat3 stretch()
{
  Mat3 e = Mat3::Zero();
  e(0, 0) = 1.0;
  return e;
}
/// gamma = 1 in the plane of x and y, without rotation.
Mat3 shear()
{
  Mat3 e = Mat3::Zero();
  e(0, 1) = e(1, 0) = 0.5;
  return e;
}
/// Largest shear stress that must vanish by the mirror symmetry of the crystal.
double forbidden(const Mat3& along, const Mat3& across)
{
  Mat3 a = along, b = across;
  a.diagonal().setZero();
  b.diagonal().setZero(); // a shear strain has normal stresses of second order
  b(0, 1) = b(1, 0) = 0.0;
  return std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}
Mat3 oblique_rotation()
{
  return Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
}

} // namespace

TEST_CASE(
    "A face-centred crystal of bonded particles without spin has C11 = 2 (k_n+k_s)/a, "
    "C12 = (k_n-k_s)/a, C44 = (k_n+k_s)/a",
    "[verification][dem]")
{
  // Sum over the twelve branches n of a strain eps, with V = a^3/4 and a = sqrt(2) d:
  //   sigma = d^2/(2 V) sum [(k_n - k_s) (n.eps.n) n (x) n + k_s (eps.n) (x) n]
  const double a = std::sqrt(2.0) * d;
  for (const double kappa : {1.0, 1.7, 4.0})
    for (const Mat3& turn : {Mat3(Mat3::Identity()), oblique_rotation()})
      for (const int n_steps : {1, 10}) {
        const Crystal c{face_centred(), kappa, turn, n_steps};
        const auto [k_n, k_s] = c.stiffness();
        const double C11 = 2.0 * (k_n + k_s) / a, C12 = (k_n - k_s) / a, C44 = 0.5 * C11;
        const auto errors = [&](double strain) { // over C11: C12 may be 0
          const Mat3 along = c.stress(stretch(), strain),
                     across = c.stress(shear(), strain);
          CHECK(forbidden(along, across) < 1e-9 * C11); // round-off; measured 5e-11
          return std::array{
              std::abs(along(0, 0) - C11) / C11,
              std::max(std::abs(along(1, 1) - C12), std::abs(along(2, 2) - C12)) / C11,
              std::max(std::abs(across(0, 1) - C44), std::abs(across(1, 0) - C44)) / C11};
        };
        const auto coarse = errors(1e-4), fine = errors(1e-5);
        CAPTURE(kappa, n_steps, coarse, fine);
        // Of first order in the strain, which lengthens the branches: 1.45 and 0.125 times
        // the strain at most. C44 is the mean of both signs: of second order, measured
        // 2.9e-10 at 1e-4, near round-off.
        CHECK(fine[0] < 1.5e-5);
        CHECK(coarse[0] / fine[0] == Approx(10.0).epsilon(0.01));
        CHECK(fine[1] < 1.3e-6);
        CHECK(coarse[1] / fine[1] == Approx(10.0).epsilon(0.01));
        CHECK(coarse[2] < 5e-10);
        CHECK(fine[2] < 1e-10);
      }
}

TEST_CASE("A simple cubic crystal of bonded particles without spin has E = k_n/d, C12 = 0, "
          "C44 = k_s/(2 d)",
          "[verification][dem]")
{
  for (const double kappa : {1.0, 1.7, 4.0})
    for (const Mat3& turn : {Mat3(Mat3::Identity()), oblique_rotation()}) {
      const Crystal c{simple_cubic(), kappa, turn, 10};
      const auto [k_n, k_s] = c.stiffness();
      const auto error = [&, k_n = k_n](double strain) { // no C12, so C11 = E
        const Mat3 along = c.stress(stretch(), strain);
        CHECK(std::abs(along(1, 1)) < 1e-12 * along(0, 0));
        CHECK(std::abs(along(2, 2)) < 1e-12 * along(0, 0));
        return std::abs(along(0, 0) * d / k_n - 1.0);
      };
      const double coarse = error(1e-4), fine = error(1e-5);
      CAPTURE(kappa, coarse, fine);
      CHECK(fine < 1.1e-5); // the branch is longer by the strain
      CHECK(coarse / fine == Approx(10.0).epsilon(1e-3));
      const Mat3 across = c.stress(shear(), 1e-5);
      CHECK(across(0, 1) == Approx(0.5 * k_s / d).epsilon(1e-9)); // measured 6e-11
      CHECK(across(1, 0) == Approx(0.5 * k_s / d).epsilon(1e-9));
    }
}
