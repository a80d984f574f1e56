// dem/README.md, Time step: the stable step of networks of particles against closed forms
// and against runs.
#include "dem/assembly/step.h"
#include "tests/support/catch.h"
#include "tests/support/strain_controlled_assembly.h"

#include <Eigen/Eigenvalues>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

StableStep look_at(Assembly& a)
{
  StableStep step;
  find_stable_step(step, a, {}, 0.0, a.motion.damping);
  return step;
}

/// Squared largest frequency of the face-centred crystal over all wave vectors of its
/// periodic cell of n^3 unit cells, over 1/m: the largest eigenvalue of
///
///   D(q) = sum over 12 neighbours [k_s I + (k_n - k_s) n n] (1 - cos(q.r))
///
/// Bonds r = +-(a/2)(1, 1, 0) and so on; particles do not spin.
double largest_of_zone(int n, double k_n, double k_s)
{
  std::vector<Vec3> neighbours; // in units of a/2
  for (const double s : {-1.0, 1.0})
    for (const double t : {-1.0, 1.0})
      for (const Vec3& r : {Vec3(s, t, 0), Vec3(s, 0, t), Vec3(0, s, t)})
        neighbours.push_back(r);
  double largest = 0.0;
  for (int a = 0; a < 2 * n; ++a)
    for (int b = 0; b < 2 * n; ++b)
      for (int c = 0; c < 2 * n; ++c) {
        Mat3 D = Mat3::Zero();
        for (const Vec3& r : neighbours) {
          const double phase = pi / n * Vec3(a, b, c).dot(r);
          const Mat3 k = k_s * Mat3::Identity() + (k_n - k_s) * 0.5 * r * r.transpose();
          D += (1.0 - std::cos(phase)) * k;
        }
        largest =
            std::max(largest, Eigen::SelfAdjointEigenSolver<Mat3>(D).eigenvalues()[2]);
      }
  return largest;
}

/// A few hundred particles of several sizes at random places, bonded; bonds do not yield,
/// and nothing else acts. Its motion is linear.
Assembly specimen(double damping, double inertia_factor)
{
  Assembly a = disordered_crystal(4).assembly;
  DamageBond bond = unbreakable_bond();
  bond.E = 20e9;
  bond.kappa = 2.4;
  a.material = {bond, no_contact()};
  a.list = VerletList(0.0, a.list.skin());
  a.motion.damping = damping;
  a.motion.inertia_factor = inertia_factor;
  for (Index i = 0; i < a.particles.size(); ++i) {
    ParticleState& b = a.particles.state[i];
    for (int c = 0; c < 3; ++c) {
      const auto draw = [&](std::uint64_t purpose) {
        return 2.0 * uniform(11, i, purpose + static_cast<std::uint64_t>(c)) - 1.0;
      };
      b.v[c] = 1e-4 * draw(0);
      b.omega[c] = 1e-4 / b.R / std::sqrt(inertia_factor) * draw(3);
    }
  }
  return a;
}

double speed2(const Particles& p)
{
  double sum = 0.0;
  for (const ParticleState& b : p.state) sum += b.v.squaredNorm();
  return sum;
}

/// Whether a run at this step stays within a thousand times its first velocities.
bool stays_bounded(Assembly a, double dt, int n_steps)
{
  add_forces(a, 0.0);
  const double before = speed2(a.particles);
  for (int k = 0; k < n_steps; ++k) {
    try {
      advance(a, dt, dt, [](double) {});
    } catch (const mergel::NumericalError&) {
      return false;
    }
    if (speed2(a.particles) > 1e6 * before) return false;
  }
  return true;
}

} // namespace

TEST_CASE("The largest frequency of a free chain that stretches is 2 sqrt(k/m) "
          "sin((N-1)pi/(2N))",
          "[verification][dem]")
{
  // Modes cos(pi l (j - 1/2)/N), l = 0 to N-1, of N masses with free ends: omega^2 =
  // (4k/m) sin^2(pi l/(2N)). Soft in shear and bending, the chain has no faster mode: these
  // are below 14 k_s/m and 2.5 lambda_b^2 k_n/m.
  for (const int N : {2, 3, 8, 30, 200}) {
    Scene s;
    s.material.bond = unbreakable_bond();
    section(s.material.bond).kappa = 20.0;
    std::vector<Pair> pairs;
    const double R = 0.01;
    for (Index k = 0; k < static_cast<Index>(N); ++k) {
      s.p.add(sphere({2.0 * R * k, 0, 0}, R));
      if (k > 0) pairs.push_back({k - 1, k});
    }
    s.bond(pairs);
    Assembly a = assembly_of(s);
    const double k_n = bond_shape(section(s.material.bond), R, 0.5 / R).k_n;
    const double sine = std::sin((N - 1) * pi / (2.0 * N));
    const double omega2 = 4.0 * k_n / s.p.state[0].m * sine * sine;
    const double found = look_at(a).omega2;
    CAPTURE(N, found / omega2 - 1.0);
    // From below; the modes of a long chain lie close together at the top, so that two
    // products that raise it by 1e-4 leave some more.
    CHECK(found < (1.0 + 1e-12) * omega2);
    CHECK(found == Approx(omega2).epsilon(N < 10 ? 1e-4 : 2e-3));
  }
}

TEST_CASE("The largest frequency of a face-centred crystal is that of its zone boundary: 8 "
          "(k_n + k_s)/m without spin",
          "[verification][dem]")
{
  // At X, q = (2 pi/a)(0, 0, 1), the 8 neighbours out of the plane z = 0 move against the
  // particle (1 - cos = 2) and the 4 in it with the particle. Along z the sum of n_z^2 over
  // the 8 is 4:
  //
  //   D_zz = 2 [8 k_s + 4 (k_n - k_s)] = 8 (k_n + k_s)
  //
  // Particles with a very large moment of inertia do not spin.
  for (const double kappa : {1.0, 2.0, 1e6}) {
    auto w = crystal(face_centred_cell(), 4, 0.5e-3, kappa);
    w.assembly.motion.inertia_factor = 1e9;
    const ParticleState& b = w.assembly.particles.state[0];
    const double k_n = bond_shape(section(w.assembly.material.bond), b.R, 0.5 / b.R).k_n;
    const double k_s = k_n / kappa;
    REQUIRE(largest_of_zone(4, k_n, k_s) == Approx(8.0 * (k_n + k_s)).epsilon(1e-12));
    const double omega2 = 8.0 * (k_n + k_s) / b.m;
    const StableStep step = look_at(w.assembly);
    CAPTURE(kappa, step.omega2 / omega2 - 1.0);
    // Spins add k_s R^2/I over 1e9. The iteration ends at a rise of 1e-4.
    CHECK(step.omega2 < (1.0 + 1e-7) * omega2);
    CHECK(step.omega2 == Approx(omega2).epsilon(1e-3));
    CHECK(step.limit == Approx(2.0 / std::sqrt(omega2)).epsilon(5e-4));
  }
}

TEST_CASE(
    "A run of a random bonded specimen is stable at 0.98 of the stable step and blows "
    "up at 1.02 of it, with any damping and moment of inertia",
    "[verification][dem]")
{
  // Spins locked by a very large moment of inertia, free, and free with twice the moment.
  for (const double factor : {1e6, 1.0, 2.0})
    for (const double damping : {0.0, 0.2, 0.7}) {
      Assembly a = specimen(damping, factor);
      REQUIRE(a.particles.size() == 256);
      const double limit = look_at(a).limit;
      CAPTURE(factor, damping, limit);
      CHECK(stays_bounded(a, 0.98 * limit, 3000));
      CHECK_FALSE(stays_bounded(a, 1.02 * limit, 3000));
    }
}
