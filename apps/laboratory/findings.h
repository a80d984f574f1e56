/// What a run has written of itself in summary.json.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace mergel::apps {

/// Numbers by their names, which carry the unit: "Young's modulus [Pa]".
class Findings {
public:
  void add(const std::string& name, double value) { values_[name] = value; }
  /// NaN where there is none of this name.
  double at(const std::string& name) const;

private:
  std::map<std::string, double> values_;
};

struct RunFindings {
  Findings whole;
  /// By their numbers in the case, from 1; of an unload-reload those of its first unloading.
  std::map<std::size_t, Findings> stages;
};

/// None without a summary.json: a run that has not finished.
/// @throws InputError when it is no JSON
std::optional<RunFindings> read_findings(const std::filesystem::path& folder);

} // namespace mergel::apps
