/// Results of `mergel element`: history.csv and the summary.
#pragma once

#include "apps/element/element_case.h"
#include "apps/element/stage_analysis.h"
#include "apps/run/summary.h"
#include "dem/element/element_analysis.h"
#include "dem/element/element_test.h"
#include "dem/io/history.h"
#include "dem/io/state/state_file.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace mergel::apps {

class ElementHistory {
public:
  explicit ElementHistory(const std::filesystem::path& file);
  /// Continue the history `earlier`, which may be `file`, from its length when save() wrote
  /// the state. @throws InputError when it does not begin with the same bytes
  ElementHistory(const std::filesystem::path& file, const std::filesystem::path& earlier,
                 const dem::State& state);
  /// Add its length and checksum. @param history null on all ranks but the first
  static void save(dem::State& state, const ElementHistory* history);
  /// A line on a history that is missing; "" where it is there.
  /// @throws InputError when `file` does not begin with the bytes that `state` records
  static std::string check(const std::filesystem::path& file, const dem::State& state);

  void add(const dem::ElementRecord& r, const StageLabel& stage);
  /// @throws NumericalError when another program has touched the file
  void require_in_place() const { history_.require_in_place(); }

private:
  dem::History history_;
};

/// What the analysis of the stages needs of the records.
std::vector<StagePoint> points_of(const std::vector<dem::ElementRecord>& records);

/// The final states of this run and of others, and the line fitted to them, if possible.
struct CriticalStates {
  std::vector<dem::CriticalState> states; ///< that of this run is the last
  std::optional<dem::StraightLine> line;
};
CriticalStates critical_states(const ElementCase& c, const dem::ElementRecord& last);

struct ElementSummary {
  std::vector<StageResult> stages;
  CriticalStates critical;
  dem::ElementRecord last;
  double worst_energy_error = 0.0, largest_inertial_number = 0.0, largest_rate = 0.0;
  std::size_t n_particles = 0, n_steps = 0, n_limited = 0;
  dem::StableStep stable_step;
  dem::EnergyAlarm alarm;
  const dem::Particles* particles = nullptr; ///< borrowed
  double dt = 0.0, seconds = 0.0;
};
/// Add the results to summary.json, and a line for each stage to the closing text.
void summarise(Summary& summary, const ElementCase& c, const ElementSummary& s);

} // namespace mergel::apps
