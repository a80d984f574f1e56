#include "tests/support/catch.h"

#include "dem/text.h"

using namespace mergel::dem;

TEST_CASE("a number of a message has at most six digits", "[unit][dem]")
{
  CHECK(rounded(1.8350000000000002) == "1.835");
  CHECK(rounded(8.414213562373096) == "8.41421");
  CHECK(rounded(-0.01775) == "-0.01775");
  CHECK(rounded(12.0) == "12");
  CHECK(rounded(999999.6) == "1e+06");
  CHECK(rounded(0.0) == "0");
}
