/// The keys of a case as help, as JSON and as a case to fill in.
#include "apps/case/case_forms.h"
#include "apps/help/pages.h"
#include "tests/support/small_case.h"

#include <boost/property_tree/json_parser.hpp>

#include <sstream>

using namespace mergel;
using namespace mergel::apps;
using namespace mergel::apps::test;
using mergel::match::Contains;

namespace {

/// A key of every kind.
struct Kinds {
  double diameter = std::numeric_limits<double>::quiet_NaN(), gap = 1e-3, modulus = 0.0;
  std::string shape = "round", note;
  double exponent = 0.5;
  std::map<std::size_t, std::string> stages;

  void declare(CaseFile& file)
  {
    const auto section = file.section("Pile");
    file.quantity("diameter", diameter, "m", positive, "Of the \"shaft\".", "mm");
    file.quantity("gap", gap, "m", non_negative, "Between the surfaces.", "mm");
    file.derived("modulus", modulus, "Pa", positive, "2 E", "Of the contact.", "GPa");
    file.choice("shape", shape, {"round", "square"}, "Of the section.");
    {
      const auto only = file.only_if("shape", {"square"});
      file.number("exponent", exponent, positive, "Of the corner.");
    }
    file.text("note", note, "Anything.");
    file.numbered("stage", stages, "A stage.", "The next stage.");
  }
};

} // namespace

TEST_CASE("Numbered keys are one line of help and template", "[unit][apps]")
{
  Kinds kinds;
  CaseFile file;
  kinds.declare(file);
  std::ostringstream help;
  file.help(help);
  for (const std::string& text : {help.str(), template_of(file, "A case.")})
    CHECK_THAT(text, Contains("stage 1") && Contains("A stage.") && !Contains("stage 2") &&
                         !Contains("The next stage."));
}

TEST_CASE("The keys as JSON are read back by a parser of JSON", "[unit][apps]")
{
  Kinds kinds;
  CaseFile file;
  kinds.declare(file);
  std::istringstream text("{\"keys\": " + keys_as_json(file) + "}");
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(text, tree); // throws where it is none
  const auto& keys = tree.get_child("keys");
  REQUIRE(keys.size() == 7);
  const auto& diameter = keys.front().second;
  CHECK(diameter.get<std::string>("section") == "Pile");
  CHECK(diameter.get<std::string>("key") == "diameter");
  CHECK(diameter.get<std::string>("unit") == "mm");
  CHECK(diameter.get<bool>("required"));
  CHECK(diameter.get<std::string>("meaning") == "Of the \"shaft\".");
}

TEST_CASE("A template is refused until its required values are filled in, and then read",
          "[unit][apps]")
{
  const WorkingFolder folder;
  Kinds kinds;
  CaseFile file;
  kinds.declare(file);
  const std::string text = template_of(file, "A case.");
  CHECK_THAT(text, Contains("set diameter = REQUIRED") && Contains("set gap = 1 mm") &&
                       Contains("# set modulus =   # default: 2 E") &&
                       Contains("# set exponent = 0.5") && Contains("set shape = round"));
  write("case.prm", text);
  CHECK_THROWS_WITH(file.read("case.prm"),
                    Contains("Pile/diameter = REQUIRED: is still to be filled in"));
  write("case.prm", replaced(text, "= REQUIRED", "= 2 mm"));
  file.read("case.prm");
  CHECK(kinds.diameter == 2e-3);
  CHECK(kinds.gap == 1e-3);
}

TEST_CASE("Every job with a case has a template and JSON of all its keys", "[unit][apps]")
{
  for (const Job& job : jobs) {
    CAPTURE(job.name);
    if (!job.reads_case()) {
      CHECK_THROWS_AS(template_of(job), InputError);
      CHECK_THROWS_AS(json_of(job), InputError);
      continue;
    }
    std::size_t n_keys = 0;
    job.keys([&](const CaseFile& file) { n_keys = file.descriptions().size(); });
    std::istringstream text(json_of(job));
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(text, tree);
    CHECK(tree.get_child("keys").size() == n_keys);
    CHECK_THAT(template_of(job), Contains("REQUIRED"));
  }
}
