/// The figures of summary.json.
#include "tests/support/catch.h"

#include "apps/run/summary.h"

#include <boost/property_tree/json_parser.hpp>

#include <limits>
#include <sstream>

using namespace mergel::apps;

TEST_CASE("A summary with figures that are no numbers is JSON", "[unit][apps]")
{
  using Limits = std::numeric_limits<double>;
  CHECK(number_in_json(0.1) == "0.1");
  CHECK(number_in_json(Limits::quiet_NaN()) == "null");
  CHECK(number_in_json(Limits::infinity()) == "null");
  CHECK(number_in_json(-Limits::infinity()) == "null");
  Summary summary;
  summary.number("nu [-]", -Limits::quiet_NaN());
  summary.number("E [Pa]", 2e9);
  std::istringstream text(summary.object());
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(text, tree); // throws where it is none
  CHECK(tree.get<std::string>("nu [-]") == "null");
  CHECK(tree.get_child("E [Pa]").get_value<double>() == 2e9);
}
