/// The stress of a specimen where its test begins.
#include "tests/support/catch.h"

#include "apps/specimen/start_stress.h"

#include "dem/error.h"

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

TEST_CASE("The stress at the start is said in MPa and summarised in Pa, with p and q",
          "[unit][apps]")
{
  const dem::Vec3 stress(500001, 700001, 1200004);
  CHECK(report_on_start(stress, "of the cell", borne_by_contacts) ==
        "stress at the start, of the cell: p 0.8, q 0.6 MPa (x 0.5, y 0.7, z 1.2 MPa), "
        "borne by "
        "its contacts: bonds begin without load\n");

  // A specimen without stress has no -0.
  CHECK_THAT(report_on_start(along_axes(dem::Mat3::Zero()), "of the cell", "by nothing"),
             Contains("p 0, q 0 MPa (x 0, y 0, z 0 MPa)"));
  CHECK(along_axes(dem::Vec3(1.0, -2.0, 3.0).asDiagonal()) == dem::Vec3(-1.0, 2.0, -3.0));

  Summary summary;
  add_start(summary, stress);
  for (const char* member :
       {"\"p at the start [Pa]\": 800002", "\"q at the start [Pa]\": 600003",
        "\"stress x at the start [Pa]\": 500001", "\"stress y at the start [Pa]\": 700001",
        "\"stress z at the start [Pa]\": 1200004"})
    CHECK_THAT(summary.object(), Contains(member));
}

TEST_CASE("A checkpoint keeps the stress at the start, and one without it is refused",
          "[unit][apps]")
{
  dem::State state(0);
  CHECK_THROWS_AS(load_start(state), InputError);
  const dem::Vec3 stress(0.1, -0.2, 0.3);
  save_start(state, stress);
  CHECK(load_start(state) == stress);
}
