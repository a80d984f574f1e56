#include "tests/support/catch.h"

#include "dem/element/element_analysis.h"
#include "dem/notation.h"

#include <cmath>

using namespace mergel::dem;

namespace {

/// Modulus E up to the stress s_y, then E_t [Pa]; all strains shifted by a bedding error.
Curve bilinear(double E, double s_y, double E_t, double bedding)
{
  Curve c;
  for (int k = 0; k <= 400; ++k) {
    const double eps = 1e-5 * k, elastic = s_y / E;
    c.strain.push_back(eps + bedding);
    c.stress.push_back(eps < elastic ? E * eps : s_y + E_t * (eps - elastic));
  }
  return c;
}

} // namespace

TEST_CASE("A secant between records is that of the straight line through both ends",
          "[unit][dem]")
{
  const Curve c = bilinear(1e9, 1e6, 1e8, 0.0);
  CHECK(*secant(c, 1.33e-4, 7.77e-4) == Approx(1e9).epsilon(1e-12));
  // 0.5 of the strain on each branch
  CHECK(*secant(c, 5e-4, 1.5e-3) == Approx(0.5 * (1e9 + 1e8)).epsilon(1e-12));
  CHECK_FALSE(secant(c, 1e-4, 5e-3)); // the curve ends at 4e-3
}

TEST_CASE(
    "The offset yield of a bilinear curve is where the offset line cuts its second branch",
    "[unit][dem]")
{
  // s_y + E_t (x - s_y/E) = E (x - offset)  =>  x - s_y/E = E offset/(E - E_t)
  for (const double bedding : {0.0, 2e-4}) {
    const double E = 1e9, E_t = 2e8, s_y = 1e6, offset = 2e-4;
    const Curve c = bilinear(E, s_y, E_t, bedding);
    const auto y = offset_yield(c, E, offset, 1e-4 + bedding);
    REQUIRE(y);
    const double beyond = E * offset / (E - E_t);
    CHECK(y->strain == Approx(s_y / E + beyond + bedding).epsilon(1e-12));
    CHECK(y->stress == Approx(s_y + E_t * beyond).epsilon(1e-12));
  }
  CHECK_FALSE(offset_yield(bilinear(1e9, 1e9, 1e9, 0.0), 1e9, 2e-4, 1e-4)); // never yields
}

TEST_CASE("A peak and the minimum after it are of one fall of the stress", "[unit][dem]")
{
  const Curve c{{0, 1, 2, 3, 4, 5, 6}, {0.0, 6.4, 6.35, 5.6, 5.8, 7.0, 9.0}};
  CHECK(peak(c).strain == 6.0);
  REQUIRE(first_drop(c, 0.02));
  CHECK(first_drop(c, 0.02)->peak.stress == 6.4);
  CHECK(first_drop(c, 0.02)->minimum.stress == 5.6);
  CHECK_FALSE(first_drop(c, 0.2)); // falls by 12.5 % only
  // A fall below a tenth of the largest stress is noise, and does not hide the one behind it.
  const Curve noisy{{0, 1, 2, 3, 4, 5}, {0.0, 0.5, 0.2, 6.0, 4.0, 9.0}};
  REQUIRE(first_drop(noisy, 0.02));
  CHECK(first_drop(noisy, 0.02)->peak.stress == 6.0);
  CHECK(largest_drop(c).minimum.strain == 6.0); // the curve ends at its peak
  const Curve softens{{0, 1, 2, 3}, {0.0, 4.2, 2.1, 2.6}};
  CHECK(largest_drop(softens).minimum.stress == 2.1);

  // Triaxial compression at 1.5 MPa: it collapses, hardens beyond that peak, and falls again.
  const Curve both{{0, 1, 2, 3, 4, 5, 6, 7}, {0, 3.987, 2.49, 3.9, 4.4, 4.59, 3.986, 4.5}};
  CHECK(first_drop(both, 0.02)->peak.stress == 3.987);
  CHECK(first_drop(both, 0.02)->minimum.stress == 2.49);
  CHECK(largest_drop(both).peak.stress == 4.59);
  CHECK(largest_drop(both).minimum.stress == 3.986);
}

TEST_CASE("A point at which the curve was unloaded is no peak and no yield", "[unit][dem]")
{
  // Unloaded at 5.0; reloading rejoins at 4.7, and the curve goes on to 10.
  const Curve rises{{0, 1, 2, 3, 4, 5}, {0, 5.0, 4.7, 4.9, 5.1, 10.0}, {2}};
  const Curve kept = without_reloading(rises);
  CHECK(kept.strain == std::vector<double>{0, 1, 4, 5});
  CHECK(kept.loops == std::vector<std::size_t>{2});
  CHECK_FALSE(first_drop(kept, 0.02));
  CHECK_FALSE(
      first_drop(rises, 0.02)); // and by itself: the fall to 4.7 is that of the loop
  CHECK(first_drop(Curve{rises.strain, rises.stress}, 0.02)); // without a loop it is one

  // It bears less than at the unloading, and collapses from there: the peak is 4.9.
  const Curve falls{{0, 1, 2, 3, 4, 5}, {0, 5.0, 4.7, 4.9, 2.5, 3.0}, {2}};
  const Curve weak = without_reloading(falls);
  CHECK(weak.strain == std::vector<double>{0, 1, 3, 4, 5});
  REQUIRE(first_drop(weak, 0.02));
  CHECK(first_drop(weak, 0.02)->peak.stress == 4.9);
  CHECK(first_drop(weak, 0.02)->minimum.stress == 2.5);
  CHECK(largest_drop(weak).peak.stress == 5.0);
  CHECK(largest_drop(weak).minimum.stress == 5.0); // it did not fall from there

  // A fall that has begun goes on behind a loop; where the reloading rejoins is no minimum.
  const Curve softens{{0, 1, 2, 3, 4, 5}, {0, 5.0, 4.0, 3.5, 3.9, 3.8}, {3}};
  CHECK(largest_drop(without_reloading(softens)).minimum.stress == 3.8);
  CHECK(first_drop(without_reloading(softens), 0.02)->peak.stress == 5.0);

  const Curve slowly{{0, 1, 2, 3, 4}, {0, 5.0, 4.75, 4.7, 4.4}, {3}};
  REQUIRE(first_drop(slowly, 0.1));
  CHECK(first_drop(slowly, 0.1)->peak.stress == 5.0);

  // Unloaded just behind its peak, 1 % lower: the peak is not where the user has unloaded.
  const Curve behind{{0, 1, 2, 3, 4, 5}, {0, 5.0, 4.95, 4.94, 4.0, 3.0}, {3}};
  for (const Drop& drop : {*first_drop(behind, 0.02), largest_drop(behind)}) {
    CHECK(drop.peak.stress == 5.0);
    CHECK(drop.minimum.stress == 3.0);
  }
  // The same where the curve rises again, and where a further loop ends the reloading at 4.0.
  CHECK_FALSE(first_drop(Curve{{0, 1, 2, 3, 4}, {0, 5.0, 4.95, 4.94, 6.0}, {3}}, 0.02));
  const Curve cycles{{0, 1, 2, 3, 4, 5}, {0, 5.0, 4.95, 4.0, 4.96, 6.0}, {3, 4}};
  CHECK_FALSE(first_drop(cycles, 0.02));

  // Two loops, the second before the first reloading has ended.
  const Curve twice{{0, 1, 2, 3, 4}, {0, 5.0, 4.0, 4.5, 5.5}, {2, 3}};
  CHECK(without_reloading(twice).strain == std::vector<double>{0, 1, 2, 3, 4});
  CHECK_FALSE(first_drop(without_reloading(twice), 0.02));
  CHECK(without_reloading(twice).loops == std::vector<std::size_t>{2, 3});

  // The line of slope 5 moved by 0.5 is passed across the loop, where nobody knows the curve.
  const Curve soft{{0, 1, 2, 3}, {0, 5.0, 5.1, 5.2}, {2}};
  CHECK_FALSE(offset_yield(soft, 5.0, 0.5, 0.0));
  CHECK(offset_yield(Curve{soft.strain, soft.stress}, 5.0, 0.5, 0.0));
}

TEST_CASE("Variances of a line are those of the normal equations", "[unit][dem]")
{
  // Residuals d, -2 d, d at x = 1, 2, 3 are orthogonal to 1 and x: the line stays 5 + 2 x.
  const double d = 0.1;
  const auto line = fit_line({1, 2, 3}, {7 + d, 9 - 2 * d, 11 + d});
  REQUIRE(line);
  CHECK(line->slope == Approx(2.0).epsilon(1e-12));
  CHECK(line->intercept == Approx(5.0).epsilon(1e-12));
  const double variance = 6 * d * d; // one degree of freedom
  CHECK(line->slope_variance == Approx(variance / 2.0).epsilon(1e-10));
  CHECK(line->intercept_variance ==
        Approx(variance * (1.0 / 3.0 + 4.0 / 2.0)).epsilon(1e-10));
  CHECK(line->covariance == Approx(-variance * 2.0 / 2.0).epsilon(1e-10));
  CHECK(std::isnan(fit_line({1, 2}, {3, 4})->slope_variance)); // no degree of freedom
}

TEST_CASE("The friction angle is that of Mohr's circle, whichever axis is the major one",
          "[unit][dem]")
{
  // sigma_1/sigma_3 = (1 + sin phi)/(1 - sin phi); sigma_2 does not enter
  for (const double phi : {0.3, 0.6}) {
    const double s1 = (1.0 + std::sin(phi)) / (1.0 - std::sin(phi)), s3 = 1.0;
    for (const Vec3& stress : {Vec3(s3, s3, s1), Vec3(s1, s1, s3), Vec3(s1, s3, 1.1)})
      CHECK(friction_angle(stress) == Approx(phi).epsilon(1e-12));
  }
  // q/p = 1.37 is 34 degrees in the paper, Fig. 15: lateral stress 1, axial stress a with
  // (a - 1)/(a + 2) = 1.37/3
  const double a = (3.0 + 2.0 * 1.37) / (3.0 - 1.37);
  CHECK(friction_angle({1.0, 1.0, a}) * 180.0 / pi == Approx(34.0).margin(0.2));
}

TEST_CASE(
    "The critical state line is recovered from states on it, and a state off it lowers R2",
    "[unit][dem]")
{
  std::vector<CriticalState> states;
  for (const double p : {0.5e6, 1e6, 2e6, 4e6, 6e6})
    states.push_back({p, 0.0, 1.2 - 0.02 * std::pow(p / 101325.0, 0.7)});
  const auto line = critical_state_line(states);
  REQUIRE(line);
  CHECK(line->intercept == Approx(1.2).epsilon(1e-12));
  CHECK(line->slope == Approx(-0.02).epsilon(1e-11));
  CHECK(line->R2 == Approx(1.0).epsilon(1e-12));
  states[2].e += 0.01;
  CHECK(critical_state_line(states)->R2 < 0.999);
  states.resize(1);
  CHECK_FALSE(critical_state_line(states)); // one state has no line
}
