#include "apps/laboratory/test_case.h"

#include "apps/case/case_scan.h"

#include <algorithm>

namespace mergel::apps {

TestCase test_case_of(const std::string& text, const std::string& name)
{
  TestCase result;
  CaseScan scan = scan_case(text, name);
  for (const CaseEntry& e : scan.entries) {
    if (e.section == "Loading" && e.key.starts_with("stage ") && !e.value.empty())
      result.stages.push_back(e.value);
  }
  std::sort(scan.entries.begin(), scan.entries.end(),
            [](const CaseEntry& a, const CaseEntry& b) {
              return a.section + '/' + a.key < b.section + '/' + b.key;
            });
  for (const CaseEntry& e : scan.entries) {
    // An empty value is as none; versions differ in which of these they write.
    if (e.value.empty() || (e.section == "Specimen" && e.key == "file")) continue;
    std::string& to = e.key == "seed" ? result.seeds : result.other_keys;
    to += e.section + '/' + e.key + '=' + e.value + '\n';
  }
  return result;
}

TestCase read_test_case(const std::filesystem::path& folder)
{
  const auto file = folder / "resolved.prm";
  return test_case_of(read_case_text(file), file.string());
}

} // namespace mergel::apps
