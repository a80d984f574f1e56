/// Keeps a run from being lost: checkpoints when they are due, and an orderly end when the
/// run is told to stop.
#pragma once

#include "apps/case/case_file.h"
#include "apps/run/signals.h"
#include "dem/io/state/checkpoint.h"
#include "dem/timer.h"

#include <functional>
#include <limits>
#include <string>

namespace mergel::apps {

/// How often a checkpoint is written.
struct Cadence {
  double seconds = std::numeric_limits<double>::infinity(); ///< of wall-clock time
  std::uint64_t steps = 0;                                  ///< 0: not by steps
};

/// "10 min", "5000 steps" or "never". @throws InputError saying what is expected
Cadence to_cadence(const std::string& text);

/// Key `Output/checkpoint every`.
struct CheckpointKey {
  std::string text = "10 min";
  Cadence every; ///< the same, set by complete()
};
/// In the open section. @pre file.section("Output") lives
void declare(CaseFile& file, CheckpointKey& key);
/// @throws InputError naming file, line and key
void complete(const CaseFile& file, CheckpointKey& key);

/// A failure whose words already say how to go on.
struct Remedied : CollectiveFailure {
  using CollectiveFailure::CollectiveFailure;
};

/// The run was told to stop, and did so behind a checkpoint.
struct Stopped : Remedied {
  using Remedied::Remedied;
};

struct KeeperSpec {
  std::filesystem::path folder; ///< of the results; the last two checkpoints stay there
  std::string job;
  std::string case_text; ///< the complete case
  Cadence every;
  double end = std::numeric_limits<double>::infinity(); ///< dem::wall_clock() at --walltime
  std::filesystem::path restarted_from = {};            ///< empty: from the beginning
};

class Keeper {
public:
  explicit Keeper(KeeperSpec spec);

  /// Where the run is.
  struct Position {
    std::uint64_t step;
    double time;       ///< [s]
    const char* stage; ///< in words
  };

  /// Call between steps, on all ranks. Writes a checkpoint when one is due: by time or
  /// steps, when a rank got SIGUSR1 or SIGTERM, before the walltime is over. No bit of the
  /// run depends on it.
  /// @param put adds the state of the run, each rank its part; collective
  /// @throws Stopped after SIGTERM and before the end of the walltime; CollectiveFailure
  ///   when the checkpoint cannot be written, naming the last good one
  void after_step(const dem::Communicator& comm, const Position& at,
                  const std::function<void(dem::State&)>& put);

  /// "; the last checkpoint is ..., continue with ...", for a message on a failure.
  std::string remedy() const;

  /// Throw the exception that is being handled, with the remedy: what all ranks know as
  /// Remedied, another failure of run, system or library (exit code 2) as a NumericalError;
  /// bad input and bugs as they are.
  /// @param leave_figures writes what was found until the run went unstable, and how that is
  ///   said; collective, may throw CollectiveFailure
  /// @pre called from a catch block
  [[noreturn]] void rethrow_with_remedy(
      const std::function<void(const std::string&)>& leave_figures = {}) const;

  std::size_t n_written() const { return n_written_; }
  double longest_write() const { return longest_; } ///< [s]

private:
  enum Wish : int { none, write, stop_in_time, stop };
  Wish wish_here(const dem::Communicator& comm, const Position& at);
  void write_now(const dem::Communicator& comm, const Position& at,
                 const std::function<void(dem::State&)>& put);
  std::string how_to_continue() const;
  std::string remedy_of_instability() const;

  KeeperSpec spec_;
  Signals signals_;
  std::filesystem::path last_;
  double written_, asked_;               ///< instants [s]
  double longest_ = 0.0, between_ = 0.0; ///< longest write, and time between two looks [s]
  bool has_estimate_ = false; ///< longest_ is measured, or guessed from the bytes
  std::size_t n_written_ = 0;
};

} // namespace mergel::apps
