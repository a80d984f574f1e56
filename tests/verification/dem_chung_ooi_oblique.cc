// Tests 4 to 8 of Chung & Ooi (2011), oblique impacts and impacts with spin: see
// chung_ooi.h.
//
// A linear impact of solid spheres depends on psi = |slip|/(mu v_n) and kappa alone. With
// 1/m_t = 7/(2 m*) the inverse mass of the contact point along t:
//
//   psi < kappa              sticks from the start, slides at the end
//   kappa < psi < 7 - kappa  slides, sticks, slides
//   7 - kappa < psi          slides throughout
//
// by comparing the rates k_s |slip| and mu f_n' with slip = slip_0 - 7/2 mu v_n (1 - cos).
#include "tests/support/catch.h"

#include "tests/verification/chung_ooi.h"

#include <array>
#include <utility>
#include <vector>

using namespace mergel::dem;
using namespace mergel::dem::test;
using namespace mergel::dem::test::chung_ooi;

namespace {

enum Regime { sticks_first, slides_first, slides_throughout };

Regime regime(const Impact& c)
{
  const double psi = std::abs(c.slip()) / (c.mu * c.v_n());
  if (psi < c.kappa) return sticks_first;
  return psi < 7.0 - c.kappa ? slides_first : slides_throughout;
}

/// After sliding throughout: the impulse along t is mu times that along n, 2 m* v_n.
///
///   v_t' = v_t -+ 2 mu v_n,
///   omega' = omega -+ 5 mu m* v_n/(m R) (1 - share pi delta/(4 R))
///
/// The arm shrinks by its share of the overlap, 1 at a plane and 1/2 between particles. The
/// rotation of the pair during the impact is left out: of order delta/R.
Rebound after_sliding(const Impact& c)
{
  const double way = c.slip() > 0.0 ? -1.0 : 1.0, v_n = c.v_n();
  const auto spin = [&](const Ball& b) {
    const double arm = 1.0 - pi * c.peak_overlap() / (4.0 * b.R) * (c.j ? 0.5 : 1.0);
    return b.spin + way * 5.0 * c.mu * c.m_star() * v_n / (b.m() * b.R) * arm;
  };
  Rebound r{-v_n, c.v_t() + way * 2.0 * c.mu * v_n, spin(c.i), c.j ? spin(*c.j) : 0.0, 0.0};
  const auto energy = [&](double v_t, double spin_i, double spin_j) {
    return 0.5 * (c.m_star() * v_t * v_t + c.i.inertia() * spin_i * spin_i +
                  (c.j ? c.j->inertia() * spin_j * spin_j : 0.0));
  };
  r.lost =
      energy(c.v_t(), c.i.spin, c.j ? c.j->spin : 0.0) - energy(r.v_t, r.spin_i, r.spin_j);
  return r;
}

/// After sticking throughout, mu without bound and delta/R to 0: the slip oscillates as
/// slip_0 cos(omega_t t) with omega_t^2 = 7 k_s/(2 m*), so omega_t T = pi
/// sqrt(7/(2 kappa)). The energy of the shear spring at separation is lost.
Rebound after_sticking(const Impact& c)
{
  const double swing = pi * std::sqrt(3.5 / c.kappa);
  const double change = c.slip() * (1.0 - std::cos(swing));
  const auto spin = [&](const Ball& b) {
    return b.spin - 5.0 / 7.0 * c.m_star() / b.m() * change / b.R;
  };
  const double u = c.slip() * std::sin(swing);
  return {-c.v_n(), c.v_t() - 2.0 / 7.0 * change, spin(c.i), c.j ? spin(*c.j) : 0.0,
          c.m_star() / 7.0 * u * u};
}

/// Largest distance from the reference in each regime.
using Errors = std::array<double, 3>;
Errors largest_errors(const std::vector<Impact>& table, double n,
                      const std::vector<double>& phases)
{
  Errors e{};
  for (const Impact& c : table) {
    const Rebound exact = Reference(c).rebound();
    for (const double phase : phases)
      e[regime(c)] = std::max(e[regime(c)], difference(c, run(c, {n, phase, 0.0}), exact));
  }
  return e;
}

/// The kernel agrees with the equations of motion in all three regimes. Numbers in the
/// comments are the largest of tests 4 to 8, at T/1000 and over the speed of approach.
void check_table(const std::vector<Impact>& table)
{
  const std::vector<double> anywhere{0.1, 0.3, 0.5, 0.7, 0.9}, on_a_step{0.0};
  const Errors coarse = largest_errors(table, 200.37, anywhere);
  const Errors fine = largest_errors(table, 1000.37, anywhere);
  const Errors coarse_on_step = largest_errors(table, 200.37, on_a_step);
  const Errors fine_on_step = largest_errors(table, 1000.37, on_a_step);
  CAPTURE(coarse, fine, coarse_on_step, fine_on_step);

  // The step of the first contact counts in full for the shear spring, though the contact
  // exists in a part of it only. While it sticks the spring keeps this error: first order,
  // measured 4.7e-4. With the first contact at the end of a step the order is two, 5.0e-6.
  CHECK(fine[sticks_first] < 5e-4);
  CHECK(coarse[sticks_first] / fine[sticks_first] == Approx(5.0).epsilon(0.05));
  CHECK(fine_on_step[sticks_first] < 6e-6);
  CHECK(coarse_on_step[sticks_first] / fine_on_step[sticks_first] > 9.0);
  // 1.9e-5 for polyethylene, 2.6e-6 for the others: the arm is that of the step's end, an
  // error of (delta/R) (dt/T), and only polyethylene has delta/R = 0.025.
  CHECK(fine[slides_first] < 2.5e-5);
  CHECK(coarse[slides_first] / fine[slides_first] > 5.0);
  // 2.0e-6, second order: the impulses of a sampled half sine.
  CHECK(fine[slides_throughout] < 2.5e-6);
  CHECK(coarse[slides_throughout] / fine[slides_throughout] > 12.0);
}

/// Where the contact slides throughout, the kernel agrees with the closed form within
/// `limit` times the speed of approach.
template <class Limit>
void check_sliding(const std::vector<Impact>& table, Limit&& limit)
{
  int n = 0;
  for (const Impact& c : table)
    if (regime(c) == slides_throughout) {
      CAPTURE(c.v_t(), c.i.spin);
      CHECK(difference(c, run(c, {1000.37}), after_sliding(c)) < limit(c));
      ++n;
    }
  CHECK(n >= 6);
}
/// At a plane nothing is left out: measured 1.9e-6, as against the reference.
double exact(const Impact&)
{
  return 2.5e-6;
}
/// The rotation of the pair: measured 0.27, 0.09 and 0.18 delta/R in tests 7, 8 and 8 with
/// both particles free.
double turn(const Impact& c)
{
  return 0.3 * c.peak_overlap() / c.i.R;
}

/// Spins of tests 6 to 8 [rad/s].
const std::vector<double> spins_tried{0.175, 0.5, 0.9, 1.3, 2.0, 3.0, 4.0, 5.0, 9.0, 22.0};

} // namespace

TEST_CASE(
    "The reference of the oblique impacts agrees with the closed forms of sliding and "
    "sticking",
    "[verification][dem]")
{
  for (const double v_t : {10.0, -20.0, 40.0}) {
    const Impact c = impact_of(steel, 0.3, {1e-5, steel.rho, 5.0, v_t});
    CHECK(difference(c, Reference(c).rebound(), after_sliding(c)) < 1e-11); // 4e-13
  }
  const Ball ball{0.1, 2700.0, 0.2, 0.3, 1.0}, large{0.2, 2700.0, 0.0, 0.0, 3.0};
  for (const double kappa : {0.7, 1.2, 2.0})
    for (Impact c : {Impact{ball}, Impact{ball, large}}) {
      c.kappa = kappa;
      c.mu = 1e9;
      const auto error = [&](double overlap) { // of R
        c.k_n = c.m_star() * std::pow(c.v_n() / (overlap * c.i.R), 2);
        return difference(c, Reference(c).rebound(), after_sticking(c));
      };
      const double thick = error(1e-4), thin = error(1e-5);
      CAPTURE(kappa, thick, thin); // the closed form is the limit of no overlap: order one
      CHECK(thin < 7e-5);
      CHECK(thick / thin == Approx(10.0).epsilon(0.01));
    }
}

TEST_CASE(
    "A particle that cannot slide rebounds with its slip times cos(pi sqrt(7/(2 kappa)))",
    "[verification][dem]")
{
  const Ball ball{0.1, 2700.0, 0.2, 0.3, 1.0}, large{0.2, 2700.0, 0.0, 0.0, 3.0};
  for (const double kappa : {0.7, 1.2, 2.0})
    for (Impact c : {Impact{ball}, Impact{ball, large}}) {
      c.kappa = kappa;
      c.mu = 1e9;
      c.k_n = c.m_star() * std::pow(c.v_n() / (1e-6 * c.i.R), 2);
      // The first contact is at the end of a step and the separation in the middle of one,
      // where dropping the shear force leaves the right impulse; elsewhere up to half a
      // step of it would be missing.
      const Rebound closed = after_sticking(c);
      double lost = 0.0;
      const auto error = [&](double n) {
        Rebound r = run(c, {n, 1e-3, 0.0});
        lost = std::exchange(r.lost, closed.lost);
        return difference(c, r, closed);
      };
      const double coarse = error(200.5), fine = error(1000.5);
      CAPTURE(kappa, coarse, fine, lost / closed.lost);
      CHECK(fine < 3e-5); // measured 2.0e-5, second order
      CHECK(coarse / fine > 15.0);
      // The spring loses its load within a step: first order, measured 0.8 %.
      CHECK(lost == Approx(closed.lost).epsilon(0.01));
    }
}

TEST_CASE(
    "Chung and Ooi 4: a particle that hits a plane at 3.9 m/s and 5 to 85 degrees sticks "
    "and slides by the equations of motion",
    "[verification][dem]")
{
  std::vector<Impact> table;
  for (const Solid& solid : {aluminium_oxide, aluminium})
    for (const double degrees : {5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 85.0}) {
      const double theta = degrees * pi / 180.0;
      Impact c = impact_of(solid, 0.092, {0.0025, solid.rho, 3.9});
      c.i.v_n = 3.9 * std::cos(theta); // the stiffness stays that of 3.9 m/s
      c.i.v_t = 3.9 * std::sin(theta);
      table.push_back(c);
      if (regime(c) != slides_throughout) continue;
      // As plotted in the article: restitution along t, f = 1 - mu (1+e)/tan(theta),
      // measured to 1.2e-7; spin 5 mu (1+e) v_n/(2 R), less by the overlap, pi delta/(4 R)
      // <= 3.2e-3.
      const Rebound r = run(c, {1000.37});
      CHECK(r.v_t / c.v_t() == Approx(1.0 - 2.0 * c.mu / std::tan(theta)).epsilon(2e-7));
      const double shorter = pi * c.peak_overlap() / (4.0 * c.i.R);
      CHECK(-c.i.R * r.spin_i / (5.0 * c.mu * c.v_n()) ==
            Approx(1.0 - shorter).epsilon(1e-6));
    }
  check_table(table);
  check_sliding(table, exact);
}

TEST_CASE(
    "Chung and Ooi 5: a particle that hits a plane at 5 m/s, with 0.1 to 40 m/s along it, "
    "sticks and slides by the equations of motion",
    "[verification][dem]")
{
  std::vector<Impact> table;
  for (const Solid& solid : {steel, polyethylene})
    for (const double v_t : {0.1, 0.5, 1.0, 1.5, 2.5, 5.0, 7.5, 10.0, 20.0, 40.0})
      table.push_back(impact_of(solid, 0.3, {1e-5, solid.rho, 5.0, v_t}));
  check_table(table);
  check_sliding(table, exact);
}

TEST_CASE("Chung and Ooi 6: a spinning particle that hits a plane sticks and slides by the "
          "equations of motion",
          "[verification][dem]")
{
  std::vector<Impact> table;
  for (const Solid& solid : {aluminium, nylon})
    for (const double spin : spins_tried)
      table.push_back(impact_of(solid, 0.4, {0.1, solid.rho, 0.2, 0.0, spin}));
  check_table(table);
  check_sliding(table, exact);
}

TEST_CASE("Chung and Ooi 7: two equal particles of equal spin stick and slide by the "
          "equations of motion, and those of opposite spin keep it",
          "[verification][dem]")
{
  std::vector<Impact> table;
  for (const Solid& solid : {aluminium, copper})
    for (const double spin : spins_tried) {
      const auto ball = [&](double v_n, double w) {
        return Ball{0.1, solid.rho, v_n, 0.0, w};
      };
      table.push_back(impact_of(solid, 0.4, ball(0.2, spin), ball(-0.2, spin)));
      const Rebound equal = run(table.back());
      CHECK(equal.spin_i == Approx(equal.spin_j).epsilon(1e-13)); // none is preferred

      // As in the article: with opposite spins they roll on each other without slip.
      const Rebound opposite =
          run(impact_of(solid, 0.4, ball(0.2, spin), ball(-0.2, -spin)));
      CHECK(opposite.spin_i == Approx(spin).epsilon(1e-13));
      CHECK(opposite.spin_j == Approx(-spin).epsilon(1e-13));
      CHECK(std::abs(opposite.v_t) < 1e-13);
    }
  check_table(table);
  check_sliding(table, turn);
}

TEST_CASE(
    "Chung and Ooi 8: a spinning particle that hits one five times as large sticks and "
    "slides by the equations of motion",
    "[verification][dem]")
{
  std::vector<Impact> table;
  for (const Solid& solid : {aluminium, nylon}) // the large one 1000 times as dense
    for (const double spin : spins_tried)
      table.push_back(impact_of(solid, 0.4, {0.1, solid.rho, 0.2, 0.0, spin},
                                Ball{0.5, 1000.0 * solid.rho}));
  check_table(table);
  check_sliding(table, turn);
}

TEST_CASE(
    "A spinning particle that hits a free one of twice its size sticks and slides by the "
    "equations of motion",
    "[verification][dem]")
{
  // In test 8 the large particle is practically fixed; here both move and both spin.
  std::vector<Impact> table;
  for (const Solid& solid : {aluminium, nylon})
    for (const double spin : spins_tried)
      table.push_back(impact_of(solid, 0.4, {0.1, solid.rho, 0.2, 0.0, spin},
                                Ball{0.2, solid.rho, 0.0, 0.0, 0.5 * spin}));
  check_table(table);
  check_sliding(table, turn);
}
