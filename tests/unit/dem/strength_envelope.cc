/// Coulomb lines and stress ratios of several tests.
#include "tests/support/catch.h"

#include "dem/element/strength_envelope.h"
#include "dem/math/random.h"
#include "dem/notation.h"

#include <cmath>

using namespace mergel::dem;

namespace {

const std::vector<double> pressures{0.0, 0.5e6, 1e6, 2.5e6};

/// Circles that touch tau = c + sigma tan(phi).
std::vector<MohrCircle> circles(double c, double phi)
{
  const double N = (1.0 + std::sin(phi)) / (1.0 - std::sin(phi));
  std::vector<MohrCircle> result;
  for (const double sigma_3 : pressures)
    result.push_back({2.0 * c * std::sqrt(N) + N * sigma_3, sigma_3});
  return result;
}

} // namespace

TEST_CASE("Cohesion and friction angle are recovered from circles that touch their line",
          "[unit][dem]")
{
  for (const double phi : {0.05, 0.3, 0.6, 1.0})
    for (const double c : {0.0, 1.1e6}) {
      const auto line = coulomb_line(circles(c, phi));
      REQUIRE(line);
      CHECK(line->c == Approx(c).epsilon(1e-9).margin(1e-3));
      CHECK(line->phi == Approx(phi).epsilon(1e-9));
      // round-off of sums of squares of 1e6 Pa
      CHECK(line->c_error < 1.0);
      CHECK(line->phi_error < 1e-6);
      CHECK(line->R2 == Approx(1.0).epsilon(1e-12));
      for (const MohrCircle& m :
           circles(c, phi)) // its distance from the centre is the radius
        CHECK((line->c + m.centre() * std::tan(line->phi)) * std::cos(line->phi) ==
              Approx(m.radius()).epsilon(1e-8).margin(1e-3));
    }
}

TEST_CASE("Tests at one pressure have no Coulomb line, two have one without errors",
          "[unit][dem]")
{
  CHECK_FALSE(coulomb_line({}));
  CHECK_FALSE(coulomb_line({{5e6, 1e6}}));
  CHECK_FALSE(coulomb_line({{5e6, 1e6}, {5.1e6, 1e6}}));
  CHECK_FALSE(coulomb_line({{5e6, 1e6}, {4e6, 2e6}})); // sigma_1 falls
  const auto two = coulomb_line({{4e6, 0.0}, {7e6, 1e6}});
  REQUIRE(two);
  CHECK(two->phi == Approx(mergel::dem::pi / 6.0)); // N = 3
  CHECK(two->c == Approx(2e6 / std::sqrt(3.0)));
  CHECK(std::isnan(two->c_error));
  CHECK(std::isnan(two->phi_error));
}

TEST_CASE("Standard errors of c and phi follow from those of the line", "[unit][dem]")
{
  // sigma_1 = b + N sigma_3 with N = 3, b = 4 MPa and residuals d, -2 d, d at 0, 1, 2 MPa.
  const double d = 0.05e6, N = 3.0, b = 4e6;
  const auto line =
      coulomb_line({{b + d, 0.0}, {b + N * 1e6 - 2 * d, 1e6}, {b + N * 2e6 + d, 2e6}});
  REQUIRE(line);
  const double s2 = 6 * d * d, xx = 2e12, mean = 1e6;
  const double N_N = s2 / xx, b_b = s2 * (1.0 / 3.0 + mean * mean / xx),
               b_N = -s2 * mean / xx;
  // phi = 2 atan(sqrt(N)) - pi/2, so that dphi/dN = 1/((N + 1) sqrt(N))
  CHECK(line->phi == Approx(2.0 * std::atan(std::sqrt(N)) - pi / 2.0));
  CHECK(line->phi_error ==
        Approx(std::sqrt(N_N) / ((N + 1.0) * std::sqrt(N))).epsilon(1e-9));
  // c = b/(2 sqrt(N)): relative variance b_b/b^2 - b_N/(b N) + N_N/(4 N^2)
  const double relative = b_b / (b * b) - b_N / (b * N) + N_N / (4.0 * N * N);
  CHECK(line->c_error == Approx(line->c * std::sqrt(relative)).epsilon(1e-9));
}

TEST_CASE("Standard errors are the scatter of c and phi over many series of tests",
          "[unit][dem]")
{
  const double c = 1e6, phi = 0.6, scatter = 0.1e6;
  constexpr int n = 4000;
  double c_c = 0.0, phi_phi = 0.0, c_error = 0.0, phi_error = 0.0;
  std::uint64_t draw = 0;
  for (int series = 0; series < n; ++series) {
    std::vector<MohrCircle> tests = circles(c, phi);
    for (MohrCircle& m : tests) { // Box and Muller
      const double u = 1.0 - uniform(1, 7, draw), v = uniform(1, 8, draw);
      ++draw;
      m.sigma_1 += scatter * std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi * v);
    }
    const auto line = coulomb_line(tests);
    REQUIRE(line);
    c_c += (line->c - c) * (line->c - c) / n;
    phi_phi += (line->phi - phi) * (line->phi - phi) / n;
    c_error += line->c_error * line->c_error / n;
    phi_error += line->phi_error * line->phi_error / n;
  }
  // A variance of 4000 draws has a relative error of sqrt(2/4000) = 2.2 %, the mean of the
  // estimates, of two degrees of freedom each, 1.6 %: three times their sum of squares.
  CHECK(c_error / c_c == Approx(1.0).margin(0.085));
  CHECK(phi_error / phi_phi == Approx(1.0).margin(0.085));
}

TEST_CASE("The stress ratio is that of states on q = M p, with the error of the others",
          "[unit][dem]")
{
  const auto exact = stress_ratio({1e6, 2e6, 4e6}, {1.4e6, 2.8e6, 5.6e6});
  REQUIRE(exact);
  CHECK(exact->M == Approx(1.4).epsilon(1e-12));
  CHECK(exact->M_error < 1e-9);
  // M = (1 1 + 2 4)/(1 + 4), residuals -0.8 and 0.4
  const auto rough = stress_ratio({1.0, 2.0}, {1.0, 4.0});
  CHECK(rough->M == Approx(1.8));
  CHECK(rough->M_error == Approx(std::sqrt((0.64 + 0.16) / 5.0)));
  CHECK(std::isnan(stress_ratio({1.0}, {1.4})->M_error));
  CHECK_FALSE(stress_ratio({0.0}, {1.0}));
  // 34 degrees is q/p = 1.37 in the paper, Fig. 15
  CHECK(friction_angle_of_ratio(1.37) * 180.0 / pi == Approx(34.0).margin(0.2));
}
