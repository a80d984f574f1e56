#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include <Eigen/LU>

#include <utility>
#include <vector>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 0.03, d = 2.0 * R;

/// Stiffnesses of one bond: E A/l, over kappa, and E I/l.
struct BondSprings {
  double k_s, k_b;
};
BondSprings springs()
{
  const auto bond = unbreakable_bond();
  const double R_b = bond.lambda_b * R, A = pi * R_b * R_b, k_n = bond.E * A / d;
  return {k_n / bond.kappa, k_n * R_b * R_b / 4.0};
}

/// A row of n+1 bonded particles along x; the first is fixed.
///
/// As a beam: E I = k_b d, G A = k_s d, and per length the mass m/d and the rotary inertia
/// I_p/d; length L = n d, from the fixed centre to the last.
struct Cantilever {
  int n;
  Scene s;
  double dt;
  double angle = 0.0; ///< rotation of the last particle about z [rad]

  Cantilever(int n_bonds, double damping) : n(n_bonds)
  {
    s.material.bond = unbreakable_bond();
    s.motion.damping = damping;
    std::vector<Pair> pairs;
    for (Index k = 0; k <= static_cast<Index>(n); ++k) {
      s.p.add(sphere({d * k, 0, 0}, R));
      if (k > 0) pairs.push_back({k - 1, k});
    }
    s.bond(pairs);
    dt = stable_time_step(s, 0.48);
  }

  double L() const { return n * d; }
  ParticleState& tip() { return s.p.state[static_cast<std::size_t>(n)]; }
  Load& tip_load() { return s.p.load[static_cast<std::size_t>(n)]; }

  void step()
  {
    s.step(dt);
    s.p.state[0].x.setZero();
    s.p.state[0].v.setZero();
    s.p.state[0].omega.setZero();
    angle += dt * tip().omega.z();
  }
  /// A damped row comes to rest in some ten of its periods, which grow with n^2.
  void settle()
  {
    for (int k = 0; k < 1000 * n * n; ++k) step();
  }
};

/// Deflection and rotation of one particle, or force and moment on it.
struct Deflection {
  double y, theta;
};
using Shape = std::vector<Deflection>; ///< of particles 1 to n

/// Statics of the springs: bond b carries the loads beyond it, V_b and M_b at its contact
/// point, and
///   theta_b+1 - theta_b = M_b/k_b,   y_b+1 - y_b = R (theta_b + theta_b+1) + V_b/k_s
Shape deflected(const Shape& loads)
{
  const auto [k_s, k_b] = springs();
  const std::size_t n = loads.size();
  std::vector<double> V(n), M(n);
  double force = 0.0, moment = 0.0; // of what lies beyond, about the contact point
  for (std::size_t b = n; b-- > 0;) {
    moment += force * d + loads[b].y * R + loads[b].theta;
    force += loads[b].y;
    V[b] = force;
    M[b] = moment;
  }
  Shape u(n);
  Deflection last{0.0, 0.0};
  for (std::size_t b = 0; b < n; ++b) {
    u[b].theta = last.theta + M[b] / k_b;
    u[b].y = last.y + R * (last.theta + u[b].theta) + V[b] / k_s;
    last = u[b];
  }
  return u;
}

struct Mode {
  double omega; ///< lowest natural frequency [rad/s]
  Shape shape;
};

/// Lowest mode of the springs, omega^2 K^-1 M u = u, by inverse iteration. The second is
/// 6 times as fast, so that an iteration leaves 1/36 of the error.
Mode lowest_mode(const Cantilever& c)
{
  const ParticleState& sphere = c.s.p.state[1];
  const double m = sphere.m, I_p = sphere.inertia();
  Mode mode{0.0, Shape(static_cast<std::size_t>(c.n), {1.0, 0.0})};
  for (int k = 0; k < 30; ++k) {
    Shape inertia;
    for (const Deflection& u : mode.shape) inertia.push_back({m * u.y, I_p * u.theta});
    Shape next = deflected(inertia);
    double before = 0.0, after = 0.0; // u.M u, u.M next
    for (std::size_t i = 0; i < next.size(); ++i) {
      before += inertia[i].y * mode.shape[i].y + inertia[i].theta * mode.shape[i].theta;
      after += inertia[i].y * next[i].y + inertia[i].theta * next[i].theta;
    }
    mode.omega = std::sqrt(before / after);
    const double tip = next.back().y;
    for (Deflection& u : next) u = {u.y / tip, u.theta / tip};
    mode.shape = std::move(next);
  }
  return mode;
}

/// Corrections of Euler and Bernoulli's beam: shear = EI/(GA L^2), rotary = rho I/(rho A
/// L^2), and a tip mass of tip rho A L with the rotary inertia tip rho I L.
struct Slenderness {
  double shear, rotary, tip;
};

/// First frequency of a Timoshenko cantilever over 1.8751^2 sqrt(EI/(rho A L^4)), Euler and
/// Bernoulli's.
///
/// With xi = x/L and lambda = omega^2 rho A L^4/EI:
///   w' = theta + shear V,   theta' = M,   M' = -V - lambda rotary theta,   V' = -lambda w
/// w = theta = 0 at the fixed end; M = lambda rotary tip theta and V = lambda tip w at the
/// other.
/// Source: Timoshenko (1921); Han, Benaroya and Wei (1999), J. Sound Vib. 225, 935.
double timoshenko_over_euler(const Slenderness& beam)
{
  const auto determinant = [&](double lambda) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero(); // of w, theta, M, V
    A(0, 1) = A(1, 2) = 1.0;
    A(0, 3) = beam.shear;
    A(2, 1) = -lambda * beam.rotary;
    A(2, 3) = -1.0;
    A(3, 0) = -lambda;
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity(), exp_A = term;
    for (int k = 1; k < 60; ++k) { // |A| = 12: what follows is below 1e-18
      term = term * A / k;
      exp_A += term;
    }
    Eigen::Matrix<double, 2, 4> at_tip = Eigen::Matrix<double, 2, 4>::Zero();
    at_tip(0, 1) = -lambda * beam.rotary * beam.tip;
    at_tip(1, 0) = -lambda * beam.tip;
    at_tip(0, 2) = at_tip(1, 3) = 1.0;
    return (at_tip * exp_A.rightCols<2>()).determinant();
  };
  const double lambda_euler = std::pow(1.8751040687119611, 4);
  double low = 0.0, high = 1.001 * lambda_euler; // every correction lowers the frequency
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (determinant(middle) > 0.0 ? low : high) = middle;
  }
  return std::sqrt(low / lambda_euler);
}

/// Frequencies of the row of particles over Euler and Bernoulli's.
struct Frequencies {
  double springs;    ///< exact, of the chain of springs
  double timoshenko; ///< of the beam of the same length
  double with_tip;   ///< of that beam with half a particle at its tip
  double correction; ///< EI/(GA L^2) + rho I/(rho A L^2)
};
Frequencies frequencies(int n)
{
  const Cantilever c(n, 0.0);
  const BondSprings b = springs();
  const double m = c.s.p.state[0].m, I_p = c.s.p.state[0].inertia(), L = c.L();
  const double euler =
      std::pow(1.8751040687119611, 2) * std::sqrt(b.k_b * d / (m / d)) / (L * L);
  const Slenderness beam{b.k_b / (b.k_s * L * L), I_p / (m * L * L), 0.0};
  Slenderness with_tip = beam;
  with_tip.tip = 0.5 / n;
  return {lowest_mode(c).omega / euler, timoshenko_over_euler(beam),
          timoshenko_over_euler(with_tip), beam.shear + beam.rotary};
}

} // namespace

TEST_CASE("A cantilever of bonded particles sags by the sum of F/(k_s0 A) + F a^2/k_b0",
          "[verification][dem]")
{
  // Statics of a chain of springs: each bond carries the shear F and the moment F a, a from
  // bond to tip. Of the bending part the sum is F L^3/(3 EI) (1 - 1/(4 n^2)): beam theory,
  // to second order in the size of the particles.
  for (const int n : {4, 8, 16}) {
    Cantilever c(n, 0.7);
    const BondSprings b = springs();
    double sag_per_F = 0.0;
    for (int k = 0; k < n; ++k) {
      const double a = d * (n - k) - R;
      sag_per_F += 1.0 / b.k_s + a * a / b.k_b;
    }
    const double F = 1e-4 * c.L() / sag_per_F; // slope 1e-4: its square adds 1e-8
    c.s.add_more = [&](double) { c.tip_load().f.y() += F; };
    c.settle();
    CAPTURE(n);
    CHECK(c.tip().x.y() == Approx(F * sag_per_F).epsilon(2e-8)); // measured 1.0e-8
    const double bending = c.tip().x.y() / F - n / b.k_s;
    const double beam = std::pow(c.L(), 3) / (3.0 * b.k_b * d);
    CHECK(bending / beam == Approx(1.0 - 0.25 / (n * n)).epsilon(2e-8));

    c.s.forces(0.0); // the fixed end carries force and moment
    CHECK(c.s.p.load[0].f.y() == Approx(F).epsilon(1e-7));
    CHECK(c.s.p.load[0].t.z() == Approx(F * c.L()).epsilon(1e-7));
  }
}

TEST_CASE("A moment at its tip rotates a cantilever of bonded particles by M L/EI and "
          "deflects it "
          "by M L^2/(2 EI)",
          "[verification][dem]")
{
  // Each bond bends by M/k_b, so particle k rotates by k M/k_b, and the contact points stay
  // together: y_n = R sum (theta_k + theta_k+1) = n^2 R M/k_b. With EI = k_b d this is beam
  // theory for any number of particles.
  for (const int n : {4, 8, 16}) {
    Cantilever c(n, 0.7);
    const double EI = springs().k_b * d;
    const double M = 1e-4 * EI / c.L(); // rotation 1e-4: its square is 1e-8
    c.s.add_more = [&](double) { c.tip_load().t.z() += M; };
    c.settle();
    CAPTURE(n);
    CHECK(c.angle == Approx(M * c.L() / EI).epsilon(1e-8)); // measured 2.4e-10
    CHECK(c.tip().x.y() == Approx(M * c.L() * c.L() / (2.0 * EI)).epsilon(1e-8)); // 8.4e-10

    c.s.forces(0.0); // moment alone at the fixed end
    CHECK(c.s.p.load[0].t.z() == Approx(M).epsilon(1e-8));
    CHECK(c.s.p.load[0].f.norm() * c.L() < 1e-6 * M); // measured 4e-8 M
  }
}

TEST_CASE(
    "A cantilever of bonded particles oscillates at the lowest frequency of its springs",
    "[verification][dem]")
{
  for (const int n : {4, 8, 16}) {
    Cantilever c(n, 0.0);
    const Mode mode = lowest_mode(c);
    const double tip_speed = 1e-6 * d * mode.omega;
    const auto sphere = [&](std::size_t k) -> ParticleState& { return c.s.p.state[k + 1]; };
    for (std::size_t k = 0; k < mode.shape.size(); ++k) {
      sphere(k).v.y() = tip_speed * mode.shape[k].y;
      sphere(k).omega.z() = tip_speed * mode.shape[k].theta;
    }
    const auto speed = [&] { // of the mode
      double q = 0.0;
      for (std::size_t k = 0; k < mode.shape.size(); ++k)
        q += sphere(k).m * mode.shape[k].y * sphere(k).v.y() +
             sphere(k).inertia() * mode.shape[k].theta * sphere(k).omega.z();
      return q;
    };
    constexpr int n_periods = 4;
    double before = speed(), first = 0.0, last = 0.0;
    for (int step = 1, zeros = 0; zeros <= n_periods; ++step) {
      c.step();
      const double now = speed();
      if (before < 0.0 && now >= 0.0) {
        last = c.dt * (step - now / (now - before));
        if (zeros++ == 0) first = last;
      }
      before = now;
    }
    const double measured = 2.0 * pi * n_periods / (last - first);
    const double leapfrog = std::pow(mode.omega * c.dt, 2) / 24.0;
    CAPTURE(n, measured / mode.omega - 1.0, leapfrog);
    // Measured 1.6e-6, 1.3e-7 and 8.9e-9: the error of the leapfrog to 1 %.
    CHECK(measured / mode.omega - 1.0 == Approx(leapfrog).epsilon(0.02));
    CHECK(leapfrog < 2e-6);
  }
}

TEST_CASE(
    "With more particles the frequency of a cantilever tends to Timoshenko's, and with its "
    "length to Euler and Bernoulli's",
    "[verification][dem]")
{
  const Frequencies coarse = frequencies(32), fine = frequencies(64);
  const auto discrete = [](const Frequencies& f) { return f.springs / f.with_tip - 1.0; };
  CAPTURE(coarse.springs, discrete(coarse), discrete(fine));
  // The last particle extends by half its size beyond L. With that half as a tip mass the
  // springs agree with the beam to second order: -2.4e-4, -6.3e-5.
  CHECK(std::abs(discrete(fine)) < 7e-5);
  CHECK(discrete(coarse) / discrete(fine) == Approx(4.0).epsilon(0.05));
  // Without it they are slower by 1/n: half a particle at the tip, where the square of the
  // mode is four times its mean.
  CHECK(64.0 * (fine.springs / fine.timoshenko - 1.0) == Approx(-1.0).epsilon(0.02));
  // Shear and rotary inertia lower Euler and Bernoulli's frequency by 4.648/2 times their
  // sum, to first order in it. 4.648 = L^2 int w'^2/int w^2 of the mode, and the same of
  // w'' for the shear. The sum is 0.114 (d/L)^2 here: 2.6e-4 of the frequency at n = 32.
  for (const Frequencies& f : {coarse, fine})
    CHECK((1.0 - f.timoshenko) / f.correction == Approx(0.5 * 4.6478).epsilon(1e-3));
  CHECK((1.0 - coarse.timoshenko) / (1.0 - fine.timoshenko) == Approx(4.0).epsilon(2e-3));
}
