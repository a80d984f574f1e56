#include "apps/element/loading_stages.h"

#include "dem/error.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mergel;
using namespace mergel::apps;
using Catch::Matchers::Contains;

TEST_CASE("A loading stage is read as it is written", "[unit][apps]")
{
  const auto one = [](const std::string& text) {
    const auto stages = read_stages(text);
    REQUIRE(stages.size() == 1);
    return stages.front();
  };
  const dem::LoadingStage iso = one("isotropic to p = 5 MPa");
  CHECK(iso.kind == dem::PathKind::isotropic);
  CHECK(iso.quantity == dem::Quantity::p);
  CHECK(iso.target == 5e6);
  CHECK(one("oedometer to axial strain = 12.5 %").target == 0.125);
  CHECK(one("oedometer to volumetric strain=0.1").target == 0.1);
  CHECK(one("tension to axial strain = -1 percent").target == -0.01);
  const dem::LoadingStage at = one("triaxial at 250 kPa to axial strain = 15 %");
  CHECK(at.has_lateral);
  CHECK(at.lateral == 250e3);
  CHECK_FALSE(one("triaxial to q = 2 MPa").has_lateral);
  CHECK(one("radial dq/dp = 1.5 to p = 8 MPa").slope == 1.5);
  CHECK(std::isinf(one("radial dq/dp = inf to q = 1 MPa").slope));
  CHECK(one("unload to lateral stress = 0.1 MPa").kind == dem::PathKind::resume);

  const auto both = read_stages("unload-reload to q = 0.2 MPa");
  REQUIRE(both.size() == 2);
  CHECK(both[0].target == 0.2e6);
  CHECK(both[1].returns);
}

TEST_CASE(
    "Stages have the numbers and the words of the case; an unload-reload has parts a and b",
    "[unit][apps]")
{
  const std::vector<std::string> texts{"oedometer to axial stress = 5000 kPa",
                                       "unload-reload to axial stress = 1 MPa",
                                       "resume to axial stress = 10 MPa", ""};
  std::vector<std::string> found;
  for (const StageLabel& label : labels_of(texts))
    found.push_back(label.name() + ": " + label.text);
  CHECK(found ==
        std::vector<std::string>{"1: oedometer to axial stress = 5000 kPa",
                                 "2a: unload-reload to axial stress = 1 MPa, unloading",
                                 "2b: unload-reload to axial stress = 1 MPa, reloading",
                                 "3: resume to axial stress = 10 MPa"});
  CHECK(labels_of(texts)[2].number == 2);
  CHECK(labels_of(texts)[2].part == 2);
}

TEST_CASE(
    "A test goes on with other stages to come, not with others up to the one under way",
    "[unit][apps]")
{
  const auto read = [](const std::vector<std::string>& texts) {
    std::vector<dem::LoadingStage> stages;
    for (const std::string& text : texts)
      for (const dem::LoadingStage& stage : read_stages(text)) stages.push_back(stage);
    return stages;
  };
  const std::string shear = "triaxial to q = 2 MPa", loop = "unload-reload to q = 1 MPa",
                    unload = "unload to q = 1 MPa", on = "resume to q = 3 MPa";
  const auto earlier = read({shear, loop, on});
  CHECK(may_go_on(earlier, read({shear, unload}), 1));
  CHECK(may_go_on(earlier, read({shear, loop}), 3));
  CHECK_FALSE(may_go_on(earlier, read({shear, on}), 2));
  CHECK_FALSE(may_go_on(earlier, read({shear}), 2));
  // Of the loop only the unloading was begun: it stays a loop, and an unloading stays one.
  CHECK_FALSE(may_go_on(earlier, read({shear, unload, on}), 2));
  CHECK_FALSE(may_go_on(read({shear, unload}), read({shear, loop}), 2));
}

TEST_CASE("A loading stage that is not understood is refused with the forms expected",
          "[unit][apps]")
{
  const auto message = [](const std::string& text) -> std::string {
    try {
      read_stages(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  CHECK_THAT(message("isotropc to p = 5 MPa"), Contains("did you mean \"isotropic\"?"));
  CHECK_THAT(message("isotropic"), Contains("there is no `to`"));
  CHECK_THAT(message("isotropic to p"), Contains("axial strain = 2 %"));
  CHECK_THAT(message("isotropic to p = 5"), Contains("Pa"));
  CHECK_THAT(message("isotropic to axial strain = 5 MPa"), Contains("number"));
  CHECK_THAT(message("isotropic to r = 5 MPa"), Contains("unknown"));
  CHECK_THAT(message("axes x = fixed, y = 1 MPa to q = 1 MPa"), Contains("each axis"));
  CHECK_THAT(message("axes x = fixed, x = fixed, z = strain-controlled to q = 1 MPa"),
             Contains("axis x has two rules"));
  CHECK_THAT(message("axes x = fixed, y = fixed, z = fixed to q = 1 MPa"),
             Contains("exactly one axis must be strain-controlled"));
  CHECK_THAT(message("triaxial with 2 MPa to q = 1 MPa"), Contains("not understood"));
  CHECK_THAT(message("radial to p = 1 MPa"), Contains("dq/dp = 1.5"));
  CHECK_THAT(message("radial dq/dp = 3 to lateral stress = 1 MPa"),
             Contains("does not change along the stage"));
}
