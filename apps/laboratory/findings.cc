#include "apps/laboratory/findings.h"

#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/io/readable.h"

#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS // else the header prints a line when it is compiled
#endif
#include <boost/property_tree/json_parser.hpp>

#include <charconv>
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

/// The number of a stage in the case: 3 of "3", "3a" and "3b of cycle 2".
std::size_t number_of(const Tree& stage, std::size_t n_before)
{
  const std::string text = stage.get<std::string>("number", "");
  std::size_t number = n_before + 1; // earlier versions wrote none
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
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
        found.stages.emplace(number_of(stage, found.stages.size()), numbers_in(stage));
  return found;
}

} // namespace mergel::apps
