#include "apps/laboratory/findings.h"

#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/io/readable.h"

#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS // else the header prints a line when it is compiled
#endif
#include <boost/property_tree/json_parser.hpp>

#include <cstdlib>
#include <limits>

namespace mergel::apps {

namespace {

using Tree = boost::property_tree::ptree;

/// The members of an object that are numbers.
Findings numbers_in(const Tree& object)
{
  Findings found;
  for (const auto& [name, value] : object) {
    const std::string& text = value.data();
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == '\0') found.add(name, number);
  }
  return found;
}

} // namespace

double Findings::at(const std::string& name) const
{
  const auto found = values_.find(name);
  return found == values_.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

std::optional<RunFindings> read_findings(const std::filesystem::path& folder)
{
  const auto file = folder / "summary.json";
  if (!dem::is_readable(file)) return {};
  Tree tree;
  try {
    boost::property_tree::read_json(file.string(), tree);
  } catch (const std::exception& e) {
    throw InputError(in_one_line(e.what()) + ". Repeat the run, or leave it out.");
  }
  RunFindings found{numbers_in(tree), {}};
  for (const auto& [name, member] : tree)
    if (name == "stages")
      for (const auto& [none, stage] : member)
        if (!stage.get<std::string>("number", "").ends_with('b'))
          found.stages.push_back(numbers_in(stage));
  return found;
}

} // namespace mergel::apps
