/// --restart: finding the checkpoint, and comparing its case with the one that is to go on.
#pragma once

#include "apps/case/case_file.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/ranks.h"
#include "apps/run/same_input.h"
#include "dem/io/state/checkpoint.h"

#include <optional>

namespace mergel::apps {

/// Keep other runs out of the folder that is to go on, before its checkpoints are looked
/// at: a run that is just ending may write another one. Nothing is held when --restart and
/// --output name different folders, or none that is there. Collective; the first rank
/// holds it.
/// @throws InputError naming the run that writes there
FolderLock hold_restarted(const JobOptions& options);

/// What a run goes on from.
struct Restart {
  std::filesystem::path file;   ///< the checkpoint
  std::filesystem::path folder; ///< results of the earlier run: where the file is
  dem::Checkpoint checkpoint;
  std::vector<std::string> refused; ///< newer checkpoints that are damaged, and how
  std::vector<CaseFile::Change> changed = {}; ///< keys of the case since, by check_case()
};

/// The checkpoint at `place`: the file, or the newest good one of a folder. Nothing when
/// `place` is empty, or a folder without checkpoints: then the run begins. Collective: the
/// first rank chooses for all.
/// @throws InputError when what is there cannot be read, naming an older good one beside
///   it; when a newer one cannot be read and is not damaged: it may be whole, for another
///   user or program; when it is of another job, or another file for another rank
std::optional<Restart> find_restart(const std::filesystem::path& place,
                                    const std::string& job);

/// The results folder that --restart names: a folder, or where a checkpoint lies.
std::filesystem::path folder_to_restart(const std::filesystem::path& place);

/// Read the case that goes on: of the options, else of the checkpoint, else resolved.prm of
/// the folder that is to be restarted.
void read_case(CaseFile& file, const JobOptions& options,
               const std::optional<Restart>& restart);

/// Compare the case with that of the checkpoint, for restart.changed.
/// @param free the keys that may change, "Section/key"
/// @throws InputError naming another key that has changed: "was X, the case asks for Y"; when
///   `Motion/time step safety` was raised: the time step only falls in a run
void check_case(const CaseFile& file, Restart& restart,
                const std::vector<std::string>& free);

/// Read the case of a job that writes checkpoints, and find what it goes on from, if it
/// does. Collective.
/// @param free the keys that a restart may change, "Section/key"
/// @throws InputError as the functions above, and as complete() of the case; when the ranks
///   read different cases
template <class Case>
std::optional<Restart> take_up(CaseFile& file, Case& c, const JobOptions& options,
                               const std::string& job, const std::vector<std::string>& free)
{
  std::optional<Restart> restart = find_restart(options.restart, job);
  declare(file, c);
  on_every_rank([&] {
    read_case(file, options, restart);
    complete(file, c);
    if (restart) check_case(file, *restart, free);
  });
  require_same_case(file);
  return restart;
}

/// Files that a run reads after its folder was looked at: its case, and its checkpoint or,
/// when it begins, `others` as far as they are named.
std::vector<std::filesystem::path>
inputs_of(const JobOptions& options, const std::optional<Restart>& restart,
          const std::vector<std::filesystem::path>& others);

/// For a run that begins again: the folder of an earlier run may be used that was ended before
/// its first checkpoint.
OutputFolder folder_to_begin_in(const JobOptions& options);

/// The folder of the run, that of the checkpoint or one to begin in, looked at by the first
/// rank. Collective.
/// @param lock from hold_restarted()
/// @throws InputError as OutputFolder::check()
OutputFolder folder_of(const JobOptions& options, const std::optional<Restart>& restart,
                       const std::vector<std::filesystem::path>& inputs, FolderLock lock);

/// Where the checkpoint is once the folder is made ready: brought into another folder it gets
/// the name of its step, whatever it was called.
std::filesystem::path checkpoint_in(const std::filesystem::path& folder,
                                    const Restart& restart);

/// Make a folder ready to go on in: the checkpoint is brought along first, if it is
/// another folder, so that a run that is killed on the way can never be taken for one
/// without; what the run wrote behind the checkpoint goes, newer checkpoints are set
/// aside, which is said, and the resolved case is written. On the first rank.
/// @param inputs as of OutputFolder::commit()
void go_on_in(OutputFolder& folder, const std::vector<std::filesystem::path>& inputs,
              const CaseFile& file, const Restart& restart);

/// Whether the case that goes on has another value for this key.
bool has_changed(const Restart& restart, const std::string& section,
                 const std::string& key);

/// What the user should know: where the run goes on, what could not be read, what has
/// changed.
std::string report(const Restart& restart);

} // namespace mergel::apps
