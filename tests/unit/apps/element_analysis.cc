/// What mergel element reads off the records of its legs.
#include "apps/element/element_output.h"

#include <catch2/catch.hpp>

using namespace mergel;
using namespace mergel::apps;

namespace {

/// Records of legs that a person could draw by hand; stresses in Pa.
struct Course {
  ElementCase c;
  std::vector<dem::Outcome> outcomes;
  std::vector<dem::ElementRecord> records;

  void leg(const std::string& text)
  {
    for (const dem::Leg& l : read_legs(text)) {
      c.legs.push_back(l);
      outcomes.push_back(dem::Outcome::done);
    }
  }
  void add(std::size_t leg, double driven_strain, const dem::Vec3& strain,
           const dem::Vec3& stress, bool is_approach = false)
  {
    dem::ElementRecord r;
    r.leg = leg;
    r.driven_strain = driven_strain;
    r.of_leg = {stress, strain};
    r.is_approach = is_approach;
    records.push_back(r);
  }
  /// Axial strains and stresses at this lateral stress; the sides swell by a fifth.
  void axial(std::size_t leg, const std::vector<std::pair<double, double>>& curve,
             double lateral = 0.0)
  {
    for (const auto& [e, s] : curve)
      add(leg, e, {-0.2 * e, -0.2 * e, e}, {lateral, lateral, s});
  }
  std::vector<LegResult> results() const { return analyse(c, outcomes, records); }
};

/// NaN where it was not found.
double found(const LegResult& r, const std::string& name)
{
  for (const Finding& f : r.findings)
    if (f.name == name) return f.value;
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace

TEST_CASE("Modulus, Poisson's ratio and UCS come from the leg and those that resume it",
          "[unit][apps]")
{
  Course t;
  t.leg("compression to axial strain = 0.2 %");
  t.leg("unload-reload to axial stress = 0.5 MPa");
  t.leg("resume to axial strain = 1 %");
  t.axial(0, {{0.0, 0.0}, {1e-3, 1e6}, {2e-3, 2e6}});
  t.axial(1, {{2e-3, 2e6}, {5e-4, 0.5e6}});
  t.axial(2, {{5e-4, 0.5e6}, {2e-3, 1.9e6}});
  t.axial(3, {{2e-3, 1.9e6}, {4e-3, 4e6}, {5e-3, 3e6}, {1e-2, 1e6}});
  const auto r = t.results();
  REQUIRE(r.size() == 4);
  CHECK(found(r[0], "Young's modulus") == Approx(1e9));
  CHECK(found(r[0], "Poisson's ratio") == Approx(0.2));
  CHECK(found(r[0], "UCS") == 4e6); // of the last leg
  CHECK(found(r[0], "minimum after the peak") == 1e6);
  CHECK(std::isnan(found(r[0], "first peak before a collapse"))); // the loop is none
  CHECK(found(r[1], "secant modulus of the leg") == Approx(1e9));
}

TEST_CASE("A pulled leg has a tensile strength, an extension its -q", "[unit][apps]")
{
  Course t;
  t.leg("tension to axial strain = -1 %");
  t.axial(0, {{0.0, 0.0}, {-1e-3, -1e6}, {-2e-3, -1.9e6}, {-1e-2, -0.2e6}});
  CHECK(found(t.results()[0], "tensile strength") == 1.9e6);
  CHECK(found(t.results()[0], "Young's modulus") == Approx(1e9));

  Course e;
  e.leg("triaxial to axial strain = -2 %");
  e.axial(0, {{0.0, 3e6}, {-1e-3, 2e6}, {-2e-2, 1e6}}, 3e6);
  const LegResult r = e.results()[0];
  CHECK(found(r, "largest -q") == Approx(2e6));
  CHECK(found(r, "q/p at the end") == Approx(-2.0 / (7.0 / 3.0)));
  // sigma_1 = 3, sigma_3 = 1: sin phi = 1/2
  CHECK(found(r, "friction angle at the end") == Approx(30.0));
}

TEST_CASE("A leg that takes stress off has a modulus and no strength", "[unit][apps]")
{
  Course t;
  t.leg("isotropic to p = 5 MPa");
  t.leg("isotropic to p = 1 MPa");
  for (const double e : {0.0, 1e-3, 1e-2})
    t.add(0, e, dem::Vec3::Constant(e / 3.0), dem::Vec3::Constant(5e8 * e));
  for (const double e : {0.0, -1e-3, -8e-3})
    t.add(1, e, dem::Vec3::Constant(e / 3.0), dem::Vec3::Constant(5e6 + 5e8 * e));
  const auto r = t.results();
  CHECK(found(r[0], "largest p") == Approx(5e6));
  CHECK(found(r[1], "bulk modulus") == Approx(5e8).epsilon(2e-3)); // product of 3 strains
  CHECK(std::isnan(found(r[1], "largest p")));
  CHECK(std::isnan(found(r[1], "first peak before a collapse")));
}

TEST_CASE("The way to what a leg holds is not read, nor is q/p where p is nothing",
          "[unit][apps]")
{
  Course t;
  t.leg("triaxial at 1 MPa to axial strain = 1 %");
  t.add(0, 0.0, dem::Vec3::Zero(), {1.0, 1.0, 9e6}, true); // approach
  t.add(0, 0.0, dem::Vec3::Zero(), {-1.0, -1.0, 3.0});     // q/p = 12 of a third of a Pa
  t.axial(0, {{1e-3, 2e6}, {1e-2, 4e6}}, 1e6);
  const LegResult r = t.results()[0];
  CHECK(found(r, "largest q") == Approx(3e6));
  CHECK(found(r, "largest q/p") == Approx(1.5));
  CHECK(found(r, "friction angle at the end") ==
        Approx(std::asin(3.0 / 5.0) * 180.0 / dem::pi));
}

TEST_CASE("Along any driven axis the angle is that of the largest and the least stress",
          "[unit][apps]")
{
  Course t;
  t.leg("axes x = driven, y = 1 MPa, z = 1 MPa to x strain = 1 %");
  t.add(0, 0.0, dem::Vec3::Zero(), dem::Vec3::Constant(1e6));
  t.add(0, 1e-3, {1e-3, 0.0, 0.0}, {2e6, 1e6, 1e6});
  t.add(0, 1e-2, {1e-2, 0.0, 0.0}, {4e6, 1e6, 1e6});
  const LegResult r = t.results()[0];
  CHECK(found(r, "largest stress") == 4e6);
  CHECK(found(r, "friction angle at the end") ==
        Approx(std::asin(3.0 / 5.0) * 180.0 / dem::pi));
}
