/// The scanner of case files beside the parser whose format they have.
#include "tests/support/catch.h"
#include "tests/support/repository.h"

#include "apps/case/case_scan.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace mergel::apps;

namespace {

/// The values by ParameterHandler of the keys that the scan found, in the same order.
std::vector<std::string> parsed(const std::string& text, const CaseScan& scan)
{
  dealii::ParameterHandler prm;
  for (const auto& [section, line] : scan.sections) {
    prm.enter_subsection(section);
    prm.leave_subsection();
  }
  for (const CaseEntry& entry : scan.entries) {
    prm.enter_subsection(entry.section);
    prm.declare_entry(entry.key, "default", dealii::Patterns::Anything());
    prm.leave_subsection();
  }
  std::istringstream stream(text);
  prm.parse_input(stream, "case");
  std::vector<std::string> values;
  for (const CaseEntry& entry : scan.entries) {
    prm.enter_subsection(entry.section);
    values.push_back(prm.get(entry.key));
    prm.leave_subsection();
  }
  return values;
}

std::vector<std::string> scanned(const CaseScan& scan)
{
  std::vector<std::string> values;
  for (const CaseEntry& entry : scan.entries) values.push_back(entry.value);
  return values;
}

} // namespace

TEST_CASE("A case file has the values that deal.II's ParameterHandler reads",
          "[unit][apps]")
{
  std::vector<std::string> texts{
      "subsection A\n  set b = 1.4 mm # comment\n  SET c=2\nend\n",
      "SUBSECTION A b\n\tset\tkey of  two\t=\tx\ty  z\t\nEND\n",
      "subsection A\n  set b = publi\\\n    shed\n  set c = a = b \"c\"\nend\n",
      "subsection A\n  set b =\n  set c = 1 \\ # not continued\nend\n",
      "# \\\nsubsection A\n  set b = 3\nend # A\n\nsubsection A\n  set c = 4\nend\n",
  };
  for (const char* folder : {"apps/cases", "tests/fuzz/corpus/case"})
    for (const auto& file :
         std::filesystem::directory_iterator(mergel::test::repository() / folder))
      if (file.path().extension() == ".prm") texts.push_back(read_case_text(file.path()));
  std::size_t n_keys = 0;
  for (const std::string& text : texts) {
    CaseScan scan;
    try {
      scan = scan_case(text, "case");
    } catch (const std::invalid_argument&) {
      continue; // refused, by the corpus of damaged files
    }
    INFO(text);
    CHECK(scanned(scan) == parsed(text, scan));
    n_keys += scan.entries.size();
  }
  CHECK(n_keys > 500);
}
