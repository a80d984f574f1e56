/// The results that are read off the curves of loading stages.
#include "tests/support/catch.h"

#include "apps/element/stage_analysis.h"

#include "apps/element/loading_stages.h"

#include <limits>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

/// Records of simple loading stages; stresses in Pa.
struct RecordedTest {
  std::vector<dem::LoadingStage> stages;
  StageTexts texts;
  std::vector<dem::Outcome> outcomes;
  std::vector<StagePoint> points;

  void stage(const std::string& text)
  {
    texts[texts.size() + 1] = text;
    for (const dem::LoadingStage& l : read_stages(text)) {
      stages.push_back(l);
      outcomes.push_back(dem::Outcome::done);
    }
  }
  void add(std::size_t stage, double controlled_strain, const dem::Vec3& strain,
           const dem::Vec3& stress, bool is_approach = false, std::size_t broken = 0)
  {
    points.push_back({stage, is_approach, controlled_strain, {stress, strain}, broken});
  }
  /// Axial strains and stresses at this lateral stress; lateral strain is -0.2 times axial.
  void axial(std::size_t stage, const std::vector<std::pair<double, double>>& curve,
             double lateral = 0.0)
  {
    for (const auto& [e, s] : curve)
      add(stage, e, {-0.2 * e, -0.2 * e, e}, {lateral, lateral, s});
  }
  std::vector<StageResult> results() const
  {
    return analyse(stages, labels_of(texts), {}, outcomes, points);
  }
};

/// Value of the finding of this name; NaN if there is none.
double found(const StageResult& r, const std::string& name)
{
  for (const Finding& f : r.findings)
    if (f.name == name) return f.value;
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace

TEST_CASE("Modulus, Poisson's ratio and UCS come from the stage and those that resume it",
          "[unit][apps]")
{
  RecordedTest t;
  t.stage("compression to axial strain = 0.2 %");
  t.stage("unload-reload to axial stress = 0.5 MPa");
  t.stage("resume to axial strain = 1 %");
  t.axial(0, {{0.0, 0.0}, {1e-3, 1e6}, {2e-3, 2e6}});
  t.axial(1, {{2e-3, 2e6}, {5e-4, 0.5e6}});
  t.axial(2, {{5e-4, 0.5e6}, {2e-3, 1.9e6}});
  t.axial(3, {{2e-3, 1.9e6}, {4e-3, 4e6}, {5e-3, 3e6}, {1e-2, 1e6}});
  const auto r = t.results();
  REQUIRE(r.size() == 4);
  CHECK(found(r[0], "Young's modulus") == Approx(1e9));
  CHECK(found(r[0], "Poisson's ratio") == Approx(0.2));
  CHECK(found(r[0], "UCS") == 4e6); // of the last stage
  CHECK(found(r[0], "minimum after the UCS") == 1e6);
  CHECK(std::isnan(found(r[0], "first peak before a collapse"))); // not the loop
  CHECK(found(r[1], "secant modulus of the stage") == Approx(1e9));

  CHECK(r[0].name ==
        "compression to axial strain = 0.2 %, analysed with the stages up to 3");
  CHECK(r[1].number == "2a");
  CHECK(r[2].number == "2b");
  CHECK(r[3].number == "3");
  Summary summary;
  summarise(summary, r, {});
  CHECK_THAT(summary.object(),
             Contains("\"number\": \"2a\"") &&
                 Contains("\"unload-reload to axial stress = 0.5 MPa, unloading\"") &&
                 Contains("\"number\": \"3\"") && !Contains("\"number\": \"4\""));
  CHECK_THAT(summary.closing.str(),
             Contains("stage 2b, unload-reload to axial stress = 0.5 MPa, reloading: ") &&
                 Contains("stage 3, resume to axial strain = 1 %: "));
}

TEST_CASE("The words of a stage are a string of JSON, whatever the case has between them",
          "[unit][apps]")
{
  RecordedTest t;
  t.stage("isotropic to p =\t1 MPa");
  t.add(0, 0.0, dem::Vec3::Zero(), dem::Vec3::Zero());
  Summary summary;
  summarise(summary, t.results(), {});
  CHECK_THAT(summary.object(), Contains("\"stage\": \"isotropic to p =\\u00091 MPa\""));
}

TEST_CASE("A peak and the minimum after it are told of one fall of q", "[unit][apps]")
{
  // Collapse from 3.987 to 2.49 MPa, hardening to 4.59, a fall to 3.986.
  RecordedTest t;
  t.stage("triaxial to axial strain = 20 %");
  t.axial(0,
          {{0.0, 1.5e6},
           {4e-3, 5.487e6},
           {1e-2, 3.99e6},
           {0.1, 5.4e6},
           {0.18, 6.09e6},
           {0.19, 5.486e6},
           {0.2, 6.0e6}},
          1.5e6);
  const StageResult r = t.results()[0];
  CHECK(found(r, "largest q") == Approx(4.59e6));
  CHECK(found(r, "minimum after the largest q") == Approx(3.986e6));
  CHECK(found(r, "first peak before a collapse") == Approx(3.987e6));
  CHECK(found(r, "minimum after the first peak") == Approx(2.49e6));

  // One fall: its minimum is told once.
  RecordedTest one;
  one.stage("triaxial to axial strain = 2 %");
  one.axial(0, {{0.0, 1e6}, {4e-3, 5e6}, {1e-2, 3e6}, {2e-2, 4e6}}, 1e6);
  CHECK(found(one.results()[0], "minimum after the largest q") == Approx(2e6));
  CHECK(std::isnan(found(one.results()[0], "minimum after the first peak")));
}

TEST_CASE("A loop on the way leaves no peak, minimum or yield where it was unloaded",
          "[unit][apps]")
{
  // To 5 MPa, unloaded to 1 and reloaded, and on to 10 MPa. Reloading is softer: it ends at the
  // strain of the unloading with 4.6 MPa, 8 % less.
  RecordedTest t;
  t.stage("oedometer to axial stress = 5 MPa");
  t.stage("unload-reload to axial stress = 1 MPa");
  t.stage("resume to axial stress = 10 MPa");
  t.axial(0, {{0.0, 0.0}, {1e-3, 1e6}, {5e-3, 5e6}});
  t.axial(1, {{5e-3, 5e6}, {3e-3, 3e6}, {1e-3, 1e6}});
  t.axial(2, {{1e-3, 1e6}, {4e-3, 3.7e6}, {5e-3, 4.6e6}});
  t.axial(3, {{5e-3, 4.6e6}, {5.1e-3, 4.7e6}, {5.5e-3, 5.1e6}, {1.1e-2, 10e6}});
  const StageResult r = t.results()[0];
  CHECK(found(r, "constrained modulus") == Approx(1e9));
  CHECK(found(r, "largest axial stress") == 10e6);
  for (const char* name : {"first peak before a collapse", "minimum after the first peak",
                           "minimum after the largest axial stress"})
    CHECK(std::isnan(found(r, name)));
  CHECK(std::isnan(found(r, "oedometric yield"))); // passed across the loop
}

TEST_CASE("Unloaded behind its peak, a test has that peak and the minimum after it",
          "[unit][apps]")
{
  // 5 MPa, unloaded at 4.95 and reloaded, down to 3.
  RecordedTest t;
  t.stage("compression to axial strain = 0.6 %");
  t.stage("unload-reload to axial stress = 1 MPa");
  t.stage("resume to axial strain = 1 %");
  t.axial(0, {{0.0, 0.0}, {1e-3, 1e6}, {5e-3, 5e6}, {6e-3, 4.95e6}});
  t.axial(1, {{6e-3, 4.95e6}, {3e-3, 1e6}});
  t.axial(2, {{3e-3, 1e6}, {6e-3, 4.9e6}});
  t.axial(3, {{6e-3, 4.9e6}, {7e-3, 4.94e6}, {8e-3, 4e6}, {1e-2, 3e6}});
  const StageResult r = t.results()[0];
  CHECK(found(r, "UCS") == 5e6);
  CHECK(found(r, "minimum after the UCS") == 3e6);
  CHECK(std::isnan(found(r, "first peak before a collapse")));
  CHECK(std::isnan(found(r, "minimum after the first peak")));
}

TEST_CASE(
    "A collapse behind the largest stress, at which the user unloaded, is no first one",
    "[unit][apps]")
{
  RecordedTest t;
  t.stage("compression to axial stress = 5 MPa");
  t.stage("unload-reload to axial stress = 1 MPa");
  t.stage("resume to axial strain = 1 %");
  t.axial(0, {{0.0, 0.0}, {1e-3, 1e6}, {5e-3, 5e6}});
  t.axial(1, {{5e-3, 5e6}, {2e-3, 1e6}});
  t.axial(2, {{2e-3, 1e6}, {5e-3, 4.6e6}});
  t.axial(3, {{5e-3, 4.6e6}, {6e-3, 4.9e6}, {8e-3, 2.5e6}});
  const StageResult r = t.results()[0];
  CHECK(found(r, "UCS") == 5e6); // bore it
  CHECK(std::isnan(found(r, "minimum after the UCS")));
  CHECK(std::isnan(found(r, "first peak before a collapse")));
}

TEST_CASE("A tension stage has a tensile strength, an extension stage a largest -q",
          "[unit][apps]")
{
  RecordedTest t;
  t.stage("tension to axial strain = -1 %");
  t.axial(0, {{0.0, 0.0}, {-1e-3, -1e6}, {-2e-3, -1.9e6}, {-1e-2, -0.2e6}});
  CHECK(found(t.results()[0], "tensile strength") == 1.9e6);
  CHECK(found(t.results()[0], "Young's modulus") == Approx(1e9));

  RecordedTest e;
  e.stage("triaxial to axial strain = -2 %");
  e.axial(0, {{0.0, 3e6}, {-1e-3, 2e6}, {-2e-2, 1e6}}, 3e6);
  const StageResult r = e.results()[0];
  CHECK(found(r, "largest -q") == Approx(2e6));
  CHECK(found(r, "q/p at the end") == Approx(-2.0 / (7.0 / 3.0)));
  // sigma_1 = 3, sigma_3 = 1: sin phi = 1/2
  CHECK(found(r, "friction angle at the end") == Approx(30.0));
}

TEST_CASE("A stage that unloads has a modulus and no strength", "[unit][apps]")
{
  RecordedTest t;
  t.stage("isotropic to p = 5 MPa");
  t.stage("isotropic to p = 1 MPa");
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

TEST_CASE("A stage that softens has no modulus, and noise before the peak is no first peak",
          "[unit][apps]")
{
  RecordedTest t;
  t.stage("compression to axial strain = 1 %");
  t.stage("resume to axial strain = 2 %");
  t.axial(0, {{0.0, 0.0}, {1e-4, 60e3}, {2e-4, 40e3}, {5e-3, 1.3e6}, {1e-2, 1.2e6}});
  t.axial(1, {{1e-2, 1.2e6}, {2e-2, 0.9e6}});
  const auto r = t.results();
  CHECK(found(r[0], "UCS") == Approx(1.3e6));
  CHECK(std::isnan(found(r[0], "first peak before a collapse")));
  CHECK(std::isnan(found(r[1], "secant modulus of the stage")));
}

TEST_CASE("Records of an approach are left out, and so is q/p where p is near zero",
          "[unit][apps]")
{
  RecordedTest t;
  t.stage("triaxial at 1 MPa to axial strain = 1 %");
  t.add(0, 0.0, dem::Vec3::Zero(), {1.0, 1.0, 9e6}, true); // approach
  t.add(0, 0.0, dem::Vec3::Zero(), {-1.0, -1.0, 3.0});     // q/p = 12 of a third of a Pa
  t.axial(0, {{1e-3, 2e6}, {1e-2, 4e6}}, 1e6);
  const StageResult r = t.results()[0];
  CHECK(found(r, "largest q") == Approx(3e6));
  CHECK(found(r, "largest q/p") == Approx(1.5));
  CHECK(found(r, "friction angle at the end") ==
        Approx(std::asin(3.0 / 5.0) * 180.0 / dem::pi));
}

TEST_CASE("A state in tension has q/p and no friction angle", "[unit][apps]")
{
  RecordedTest t;
  t.stage("triaxial to axial strain = -1 %");
  t.axial(0, {{0.0, 1e6}, {-1e-3, 0.1e6}, {-1e-2, -0.28e6}}, 1e6);
  const StageResult r = t.results()[0];
  CHECK(found(r, "q/p at the end") == Approx(-1.28 / (1.72 / 3.0)));
  CHECK(std::isnan(found(r, "friction angle at the end"))); // not 90 degrees
}

TEST_CASE("Bonds that break in an approach are counted, up to the start of the strain",
          "[unit][apps]")
{
  const dem::Vec3 zero = dem::Vec3::Zero();
  RecordedTest t;
  t.stage("isotropic to p = 1 MPa");
  t.stage("triaxial at 2 MPa to axial strain = 1 %");
  t.stage("triaxial at 3 MPa to axial strain = 1 %");
  t.add(0, 0.0, zero, zero);
  t.add(0, 1e-3, zero, zero, false, 4);
  t.add(1, 0.0, zero, zero, true, 4);
  t.add(1, 1e-3, zero, zero, true, 5);
  t.add(1, 0.0, zero, zero, false, 7); // at the end of the approach
  t.add(1, 1e-3, zero, zero, false, 20);
  t.add(2, 0.0, zero, zero, true, 20);
  t.add(2, 1e-3, zero, zero, true, 29); // failed in it
  const auto r = t.results();
  CHECK_FALSE(r[0].broken_in_approach);
  CHECK(r[1].broken_in_approach == 3);
  CHECK(r[2].broken_in_approach == 9);
  CHECK(r[2].findings.empty());
}

TEST_CASE(
    "A specimen that yields in an approach, or in isotropic compression, is said to have",
    "[unit][apps]")
{
  // Bulk modulus 1 GPa to 1 MPa, then a tenth of it.
  const auto compress = [](RecordedTest& t, std::size_t stage, bool is_approach) {
    for (const auto& [v, p] :
         {std::pair{0.0, 0.0}, {5e-4, 0.5e6}, {1e-3, 1e6}, {2e-3, 1.1e6}, {3e-3, 1.2e6}})
      t.add(stage, v, dem::Vec3::Constant(1.0 - std::cbrt(1.0 - v)), dem::Vec3::Constant(p),
            is_approach);
  };
  // The offset line, p = 1 GPa (v - 2e-4), meets p = 1 MPa + 0.1 GPa (v - 1e-3) at 1.1/0.9e-3.
  const double p_yield = 1e6 * (1.0 + 0.1 * (1.1 / 0.9 - 1.0));
  const dem::Vec3 held = dem::Vec3::Constant(1.2e6);

  RecordedTest approached;
  approached.stage("triaxial at 1.2 MPa to axial strain = 1 %");
  compress(approached, 0, true);
  approached.add(0, 0.0, dem::Vec3::Zero(), held);
  approached.stage("triaxial to axial strain = 2 %");
  approached.add(1, 0.0, dem::Vec3::Zero(), held);
  const auto r = approached.results();
  REQUIRE(r[0].yield_in_approach);
  CHECK(*r[0].yield_in_approach == Approx(p_yield).epsilon(1e-9)); // round-off
  CHECK(r[0].yielded_before.empty());
  CHECK_FALSE(r[1].yield_in_approach);
  CHECK(r[1].yielded_before == "1");
  Summary summary;
  summarise(summary, r, {});
  CHECK_THAT(summary.closing.str(),
             Contains("stage 1: the specimen yielded in the approach to its stress, at p "
                      "1.022 MPa") &&
                 Contains("stage 2: the specimen had yielded before, in stage 1\n"));
  CHECK_THAT(summary.object(), Contains("\"p at yield in the approach [Pa]\": ") &&
                                   Contains("\"yielded before in stage\": \"1\""));

  RecordedTest consolidated;
  consolidated.stage("isotropic to p = 1.2 MPa");
  compress(consolidated, 0, false);
  consolidated.stage("triaxial to axial strain = 2 %");
  consolidated.add(1, 0.0, dem::Vec3::Zero(), held);
  CHECK(consolidated.results()[1].yielded_before == "1");
  CHECK(found(consolidated.results()[0], "isotropic yield") == Approx(p_yield));
}

TEST_CASE("How often the servo reached its largest rate is said where it did",
          "[unit][apps]")
{
  CHECK(servo_text(0, 1000).empty());
  CHECK_THAT(servo_text(12, 1000),
             Contains("the servo reached its largest rate 12 times in 1000 steps"));
}

TEST_CASE("The friction angle is that of the largest and smallest stress along any axis",
          "[unit][apps]")
{
  RecordedTest t;
  t.stage("axes x = strain-controlled, y = 1 MPa, z = 1 MPa to x strain = 1 %");
  t.add(0, 0.0, dem::Vec3::Zero(), dem::Vec3::Constant(1e6));
  t.add(0, 1e-3, {1e-3, 0.0, 0.0}, {2e6, 1e6, 1e6});
  t.add(0, 1e-2, {1e-2, 0.0, 0.0}, {4e6, 1e6, 1e6});
  const StageResult r = t.results()[0];
  CHECK(found(r, "largest stress") == 4e6);
  CHECK(found(r, "friction angle at the end") ==
        Approx(std::asin(3.0 / 5.0) * 180.0 / dem::pi));
}
