#include "tests/support/catch.h"

#include "apps/pile/penetration_rate.h"

using namespace mergel::apps;

TEST_CASE("A second push speeds up from where the first ended as the first did",
          "[unit][apps]")
{
  PileCase c;
  c.diameter = 2.0;
  c.cone_angle = 0.5 * mergel::dem::pi; // the cone is as high as its radius
  c.velocity = 3.0;
  c.stages = {{PileStage::Kind::penetrate, 9.0}};
  const PenetrationRate first(c);
  REQUIRE(first.travel() == Approx(10.0));
  CHECK(first.velocity(0.0) == Approx(0.03));  // 1 %, so that the pile starts to move
  CHECK(first.velocity(0.025) == Approx(1.5)); // v^2 = 2 a s over the ramp of 0.1
  CHECK(first.velocity(5.0) == 3.0);
  CHECK(first.velocity(9.975) == Approx(1.5));
  CHECK(first.velocity(10.0) == Approx(0.03));

  c.stages.front().target = 19.0;
  const PenetrationRate second(c, 10.0);
  for (const double s : {0.0, 0.01, 0.025, 0.2, 5.0, 9.95, 10.0})
    CHECK(second.velocity(10.0 + s) == Approx(first.velocity(s)).epsilon(1e-9));
}
