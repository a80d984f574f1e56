#include "tests/support/catch.h"

#include "apps/case/walltime.h"

#include "dem/error.h"

using namespace mergel;
using namespace mergel::apps;

TEST_CASE("A walltime is read in the forms that batch systems use", "[unit][apps]")
{
  CHECK(to_walltime("4h") == 14400.0);
  CHECK(to_walltime("30 min") == 1800.0);
  CHECK(to_walltime("4:00:00") == 14400.0);
  CHECK(to_walltime("90:30") == 5430.0);
  CHECK(to_walltime("1-00:00:00") == 86400.0);
  CHECK(to_walltime("2-03:04:05") == 183845.0);
  CHECK(to_walltime("0-12:30") == 45000.0);
  CHECK(to_walltime("7-12") == 648000.0);
  CHECK(to_walltime("1e-3 h") == Approx(3.6)); // '-' of an exponent, not of a day
  for (const char* wrong :
       {"", "4", "4 mm", "0 s", "1:2:3:4", "4:", ":4", "a:b", "0:00", "1-", "-1", "-1 h",
        "1-2-3", "1-2:3:4:5", "4:1-2", "0-00:00:00", "1-a", "99999999999-00"})
    CHECK_THROWS_AS(to_walltime(wrong), InputError);
}
