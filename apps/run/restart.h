/// --restart: finding the checkpoint, and comparing its case with that of the continued
/// run.
#pragma once

#include "apps/case/case_file.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/provenance.h"
#include "apps/run/ranks.h"
#include "apps/run/same_input.h"
#include "dem/io/history.h"
#include "dem/io/state/checkpoint.h"

#include <optional>

namespace mergel::apps {

/// Lock the results folder of the run to continue before its checkpoints are read, because
/// a run that is just ending may write another one. Locks nothing when --restart and
/// --output name different folders, or a folder that does not exist. Collective; the first
/// rank holds the lock.
/// @throws InputError naming the run that writes there
FolderLock hold_restarted(const JobOptions& options);

/// The checkpoint that a run continues from.
struct Restart {
  std::filesystem::path file;   ///< the checkpoint
  std::filesystem::path folder; ///< results of the earlier run, and the file
  dem::Checkpoint checkpoint;
  std::vector<std::string> refused; ///< newer checkpoints that are damaged, and how
  std::vector<CaseFile::Change> changed = {}; ///< keys changed since then, by check_case()
};

/// The checkpoint at `place`: the file, or the newest good one of a folder. Nothing when
/// `place` is empty, or a folder without checkpoints: then a new run begins. Collective:
/// the first rank chooses for all.
/// @throws InputError when the file cannot be read, naming a good one of its folder; when a
///   newer one of a folder cannot be read although it is not damaged: another user or
///   program may be able to read it; when it is of another job; when the ranks read
///   different files
std::optional<Restart> find_restart(const std::filesystem::path& place,
                                    const std::string& job);

/// The results folder that --restart names: the folder itself, or that of the checkpoint.
std::filesystem::path folder_to_restart(const std::filesystem::path& place);

/// Read the case to run: from the case file of the options, else from the checkpoint, else
/// from resolved.prm of the folder to restart.
/// @throws InputError of the case; where it is one of another job, with the name of that job
void read_case(CaseFile& file, const JobOptions& options,
               const std::optional<Restart>& restart);

/// Compare the case with that of the checkpoint, for restart.changed.
/// @param free the keys that may change, "Section/key" or "Section/key N" for all numbers
/// @throws InputError naming another key that has changed: "was X, the case asks for Y"
void check_case(const CaseFile& file, Restart& restart,
                const std::vector<std::string>& free);

/// Files that a run reads after its folder was checked: the case file unless --restart is
/// given, and the checkpoint or, for a new run, those of `others` that are not empty.
std::vector<std::filesystem::path>
inputs_of(const JobOptions& options, const std::optional<Restart>& restart,
          const std::vector<std::filesystem::path>& others);

/// The results folder of a new run. With --restart it may hold an earlier run that was
/// ended before its first checkpoint.
OutputFolder folder_to_begin_in(const JobOptions& options);

/// Make the folder of a new run ready for its files, and write the resolved case. On the
/// first rank.
/// @param inputs as of OutputFolder::commit()
void begin_folder(OutputFolder& folder, const std::vector<std::filesystem::path>& inputs,
                  const CaseFile& file, const Provenance& made);

/// The results folder of the run, that of the checkpoint or another, checked by the first
/// rank. Collective.
/// @param lock from hold_restarted()
/// @throws InputError as OutputFolder::check()
OutputFolder folder_of(const JobOptions& options, const std::optional<Restart>& restart,
                       const std::vector<std::filesystem::path>& inputs, FolderLock lock);

/// Path of the checkpoint in the folder where the run continues. Copied to another folder,
/// it is named after its step.
std::filesystem::path checkpoint_in(const std::filesystem::path& folder,
                                    const Restart& restart);

/// Prepare the folder where the run continues. To another folder the checkpoint is copied
/// first: if the run is killed meanwhile, its folder has a checkpoint. Then files written
/// after the checkpoint are removed, newer checkpoints are set aside and named on
/// std::cout, and the resolved case is written, with the earlier starts of the run. On the
/// first rank.
/// @param inputs as of OutputFolder::commit()
void prepare_continued_folder(OutputFolder& folder,
                              const std::vector<std::filesystem::path>& inputs,
                              const CaseFile& file, const Restart& restart,
                              const Provenance& made);

/// A line on a history that is missing beside its checkpoint; "" where it is there.
/// @throws InputError when it differs before the mark
std::string report_on_history(const std::filesystem::path& file,
                              const dem::HistoryMark& mark);

/// The change of this key since the checkpoint; null without one.
const CaseFile::Change* find_change(const Restart& restart, const std::string& section,
                                    const std::string& key);

/// Message to the user: checkpoints that cannot be used, the one that the run continues
/// from, and changed keys.
std::string report(const Restart& restart);

} // namespace mergel::apps
