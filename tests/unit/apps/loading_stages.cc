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
  for (const char* text :
       {"isotropic to p = 5 MPa", "radial dq/dp = 1.5 to p = 8 MPa",
        "triaxial at 0.25 MPa to axial strain = 15 %",
        "axes x = fixed, y = 0.5 MPa, z = strain-controlled to q = 2 MPa",
        "axes x = strain-controlled, y = fixed, z = fixed to x strain = 1 %"})
    CHECK(name_of(one(text)) == text);
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
