/// Files of `mergel element`: history.csv and summary.json, and the closing words.
#pragma once

#include "apps/element/element_case.h"
#include "dem/element/element_analysis.h"
#include "dem/element/element_test.h"
#include "dem/io/history.h"
#include "dem/io/state/state_file.h"

#include <filesystem>
#include <utility>
#include <vector>

namespace mergel::apps {

class ElementHistory {
public:
  explicit ElementHistory(const std::filesystem::path& file);
  /// Go on where `earlier`, which may be `file`, stood when put() wrote the state.
  /// @throws InputError when it is another
  ElementHistory(const std::filesystem::path& file, const std::filesystem::path& earlier,
                 const dem::State& state);
  /// How far it has come. @param history null on all ranks but the first
  static void put(dem::State& state, const ElementHistory* history);
  /// @throws InputError when `file` does not begin with what was written by then
  static void check(const std::filesystem::path& file, const dem::State& state);

  void add(const dem::ElementRecord& r);

private:
  dem::History history_;
};

/// A figure that was found: SI value, and how it is said.
struct Finding {
  std::string name, unit; ///< "Young's modulus", "Pa"
  double value;
};

/// One leg and what was read off it.
struct LegResult {
  std::string name;
  dem::Outcome outcome = dem::Outcome::goes_on;
  std::vector<Finding> findings;
};

/// What each leg was to find; a leg that others resume is read off with them.
/// @param outcomes of the legs that were begun; @param records of all of them, in order
std::vector<LegResult> analyse(const ElementCase& c,
                               const std::vector<dem::Outcome>& outcomes,
                               const std::vector<dem::ElementRecord>& records);

/// The last states of this run and of others, and the line through them if there is one.
struct CriticalStates {
  std::vector<dem::CriticalState> states; ///< this run's last
  std::optional<dem::StraightLine> line;
};
CriticalStates critical_states(const ElementCase& c, const dem::ElementRecord& last);

struct ElementSummary {
  std::vector<LegResult> legs;
  CriticalStates critical;
  dem::ElementRecord last;
  double worst_energy_error = 0.0, greatest_inertial_number = 0.0, greatest_rate = 0.0;
  std::size_t n_particles = 0, n_steps = 0, n_limited = 0;
  double dt = 0.0, seconds = 0.0;
};
/// @param failure that ended the test before its time, or empty
void write_summary(const std::filesystem::path& file, const ElementCase& c,
                   const ElementSummary& s, const std::string& failure);
/// @param file that holds the same
void print_summary(const std::filesystem::path& file, const ElementSummary& s);

} // namespace mergel::apps
