/// The protocol of a job that writes checkpoints: results folder, lock, restart,
/// checkpoints, signals, summary and the file of a failure (apps/run/README.md).
///
/// A job derives from CheckpointedJob and says what it computes. run_job() calls it:
///
///     a new run            a restart
///     declare, complete    declare, complete, check_restart, what_is_done
///     begin                resume
///     run                  run      between steps save, when a checkpoint is due
///     summarise            summarise      at the end, or when the run went unstable
///
/// It also needs a row in apps/run/jobs.h, its keys in a case of its own, and a page.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/unusual.h"
#include "apps/run/checkpoint_scheduler.h"
#include "apps/run/jobs.h"
#include "apps/run/restart.h"
#include "apps/run/summary.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace mergel::apps {

/// The results folder of a run that begins or resumes.
class RunFolder {
public:
  /// All arguments must outlive the object.
  /// @param restart null for a new run
  RunFolder(OutputFolder& folder, const std::vector<std::filesystem::path>& inputs,
            const CaseFile& file, const Restart* restart, Provenance made)
      : folder_(folder), inputs_(inputs), file_(file), restart_(restart),
        made_(std::move(made))
  {
  }
  const std::filesystem::path& path() const { return folder_.path(); }

  /// Make the folder ready for the files of the job, and write resolved.prm: a new folder
  /// is created, an earlier run is removed or cut back to the checkpoint. To be called
  /// once, when no input can be refused any more: until then the disk is unchanged.
  /// Collective.
  /// @throws InputError as OutputFolder::commit() and require_shared()
  void prepare();
  bool is_prepared() const { return is_prepared_; }
  /// Write resolved.prm again if it has gone since prepare(), and say so. On the first rank.
  void restore_case() const;

private:
  OutputFolder& folder_;
  const std::vector<std::filesystem::path>& inputs_;
  const CaseFile& file_;
  const Restart* restart_;
  Provenance made_;
  bool is_prepared_ = false;
};

/// Cost of a run.
struct Work {
  std::size_t n_steps; ///< since this start of the program
  double seconds;      ///< of the whole run, earlier starts included
};

/// A job as run_job() sees it. Functions are called on all ranks; those from begin() on are
/// collective.
class CheckpointedJob {
public:
  virtual ~CheckpointedJob() = default;

  // --- its case ------------------------------------------------------------------------
  /// As in jobs.h.
  virtual const char* name() const = 0;
  /// Declare every key, those of checkpoints() among them.
  virtual void declare(CaseFile& file) = 0;
  /// Check what spans several keys. @throws InputError naming file, line and key
  virtual void complete(CaseFile& file) = 0;
  virtual const CheckpointKey& checkpoints() const = 0;
  /// What is unusual of the complete case; said where a new run begins.
  virtual Remarks unusual() const = 0;
  /// Files that the case names and a new run reads; some may be empty.
  virtual std::vector<std::filesystem::path> inputs() const = 0;
  /// Keys that a restart may change, "Section/key", beside those of every job: see
  /// run_job().
  virtual std::vector<std::string> free_keys() const = 0;

  // --- its restart ---------------------------------------------------------------------
  /// Refuse a change of a free key that does not fit the checkpoint.
  /// @throws InputError naming file, line and key
  virtual void check_restart(const CaseFile& file, const Restart& restart) const = 0;
  /// Where a checkpoint is the end of this case: what the run has reached, and how it is
  /// taken further, in one line. "" where something is left to do. On the first rank.
  virtual std::string what_is_done(const Restart& restart) const = 0;

  // --- its run -------------------------------------------------------------------------
  /// Make the system of a new run, call folder.prepare(), and begin its files.
  /// @param comm must outlive the job
  virtual void begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm) = 0;
  /// The same from a checkpoint, whose arrays may be taken out. The files continue those in
  /// restart.folder.
  /// @throws InputError when the state is of another case, or its files are missing
  virtual void resume(Restart& restart, RunFolder& folder, MPI_Comm comm) = 0;
  /// Run to the end, from wherever begin() or resume() left it; may have nothing to do.
  /// @param after_step to be called between two steps; may throw
  virtual void run(const std::function<void()>& after_step) = 0;
  /// Where the run is.
  virtual CheckpointScheduler::Position position() const = 0;
  /// Add all that resume() needs, each rank its part; "seconds" is run_job()'s. Frames
  /// (apps/run/frames.h) add their number: those written after the checkpoint are removed.
  virtual void save(dem::State& state) const = 0;
  /// Look whether the files that it still writes to are where they were.
  /// @throws CollectiveFailure naming one that is lost
  virtual void require_files() const = 0;
  /// Add what was found so far: nothing before there is something.
  virtual void summarise(Summary& summary, const Work& work) const = 0;
};

/// Call `use` with every key of the job declared.
void show_keys(CheckpointedJob& job, const UseKeys& use);

/// Run a job from its command line to its end, or until it is stopped (apps/run/README.md,
/// Checkpoints and restart). Every job may change in a restart `Motion/time step safety`,
/// `Output/checkpoint every`, `Output/checkpoint at end` and `Specimen/file`.
/// @param comm all ranks of the program
/// @return the exit code
/// @throws as begin() and resume() do; as run() does, with how to continue: see
///   CheckpointScheduler::rethrow_with_remedy()
int run_job(CheckpointedJob& job, const JobOptions& options,
            MPI_Comm comm = MPI_COMM_WORLD);

} // namespace mergel::apps
