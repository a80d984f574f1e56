/// Checkpoints of a run: written when they are due, and before the run stops on a signal or
/// at the end of the walltime.
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

/// "10 min", "5000 steps" or "never". @throws InputError with the expected form
Cadence to_cadence(const std::string& text);

/// Keys `Output/checkpoint every` and `checkpoint at end`.
struct CheckpointKey {
  std::string text = "10 min";
  Cadence every;      ///< value of the text, set by complete()
  bool at_end = true; ///< write one when the run is finished
};
/// Declare the keys in the open section. @pre file.section("Output") is open
void declare(CaseFile& file, CheckpointKey& key);
/// @throws InputError naming file, line and key
void complete(const CaseFile& file, CheckpointKey& key);

/// A failure whose message already says how to continue.
struct Remedied : CollectiveFailure {
  using CollectiveFailure::CollectiveFailure;
};

/// The run was asked to stop, and stopped after it had written a checkpoint.
struct Stopped : Remedied {
  using Remedied::Remedied;
};

struct CheckpointSchedule {
  std::filesystem::path folder; ///< of the results; the last two checkpoints stay there
  std::string job;
  std::string case_text; ///< the complete case
  Cadence every;
  double end = std::numeric_limits<double>::infinity(); ///< clock() at --walltime
  std::filesystem::path restarted_from = {};            ///< checkpoint; empty: a new run
  std::function<double()> clock = dem::wall_clock;      ///< [s]; another one in tests
};

class CheckpointScheduler {
public:
  explicit CheckpointScheduler(CheckpointSchedule spec);

  /// Where the run is.
  struct Position {
    std::uint64_t step;
    double time;       ///< [s]
    std::string phase; ///< its name
  };

  /// Call between steps, on all ranks. Writes a checkpoint when one is due: by time or
  /// steps, after a rank received a signal of Signals, and before the walltime is over. The
  /// results of the run do not depend on it, bit for bit.
  /// @param save adds the state of the run, each rank its part; collective
  /// @throws Stopped after a signal that stops (Signals) and before the end of the walltime;
  ///   CollectiveFailure when the checkpoint cannot be written, naming the last good one
  void after_step(const dem::Communicator& comm, const Position& at,
                  const std::function<void(dem::State&)>& save);

  /// Write the checkpoint of a finished run, from which it can be taken further. Collective.
  /// @throws CollectiveFailure when it cannot be written
  void at_end(const dem::Communicator& comm, Position at,
              const std::function<void(dem::State&)>& save);

  /// "; the last checkpoint is ..., continue with ...", for a message on a failure.
  std::string remedy() const;

  /// Throw the exception that is being handled, with the remedy: a CollectiveFailure as
  /// Remedied, another failure of run, system or library (exit code 2) as NumericalError;
  /// bad input and bugs unchanged.
  /// @param write_results writes the results until the run became unstable, and the message
  ///   that it is given; collective, may throw CollectiveFailure
  /// @pre called from a catch block
  [[noreturn]] void rethrow_with_remedy(
      const std::function<void(const std::string&)>& write_results = {}) const;

  std::size_t n_written() const { return n_written_; }

private:
  /// In the order of their weight; stop + the number of the signal.
  enum Wish : int { none, write, stop_in_time, stop };
  int wish_here(const dem::Communicator& comm, const Position& at);
  void write_now(const dem::Communicator& comm, const Position& at,
                 const std::function<void(dem::State&)>& save);
  std::string how_to_continue() const;
  std::string remedy_of_instability() const;

  CheckpointSchedule spec_;
  Signals signals_;
  std::filesystem::path last_;
  double written_, asked_;               ///< clock at the last write and check [s]
  double longest_ = 0.0, between_ = 0.0; ///< longest write and time between checks [s]
  bool has_estimate_ = false; ///< longest_ is measured, or estimated from the size
  std::size_t n_written_ = 0;
};

} // namespace mergel::apps
