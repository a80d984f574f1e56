/// --restart: finding the checkpoint, and comparing its case with the one that is to go on.
#pragma once

#include "apps/case_file.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "dem/io/checkpoint.h"

#include <optional>

namespace mergel::apps {

/// What a run goes on from.
struct Restart {
  std::filesystem::path file;   ///< the checkpoint
  std::filesystem::path folder; ///< results of the earlier run: where the file is
  dem::Checkpoint checkpoint;
  std::vector<std::string> refused; ///< newer checkpoints that are damaged, and how
};

/// The checkpoint at `place`: the file, or the newest good one of a folder. Nothing when
/// `place` is empty, or a folder without checkpoints: then the run begins. Collective: the
/// first rank chooses for all.
/// @throws InputError when what is there cannot be read, naming an older good one beside
///   it; when a newer one cannot be read and is not damaged: it may be whole, for another
///   user or program; when it is of another job
std::optional<Restart> find_restart(const std::filesystem::path& place,
                                    const std::string& job);

/// The results folder that --restart names: a folder, or where a checkpoint lies.
std::filesystem::path folder_to_restart(const std::filesystem::path& place);

/// Read the case that goes on: of the options, else of the checkpoint, else resolved.prm of
/// the folder that is to be restarted.
void read_case(CaseFile& file, const JobOptions& options,
               const std::optional<Restart>& restart);

/// Compare the case with that of the checkpoint. Returns the changed ones of the keys
/// `free`, "Section/key".
/// @throws InputError naming another key that has changed: "was X, the case asks for Y"
std::vector<CaseFile::Change> check_case(const CaseFile& file, const Restart& restart,
                                         const std::vector<std::string>& free);

/// For a run that begins again: the folder of an earlier run may be used that was ended before
/// its first checkpoint.
/// @throws InputError when the earlier run was finished or has a checkpoint
OutputFolder folder_to_begin_in(const JobOptions& options);

/// The folder of the run: that of the checkpoint, or one to begin in.
/// @throws InputError as folder_to_begin_in()
OutputFolder folder_of(const JobOptions& options, const std::optional<Restart>& restart);

/// Make a folder ready to go on in: what the run wrote behind the checkpoint goes, newer
/// checkpoints are set aside, which is said, and the resolved case is written. On the first
/// rank.
/// @param inputs as of OutputFolder::commit()
void go_on_in(OutputFolder& folder, const std::vector<std::filesystem::path>& inputs,
              const CaseFile& file, const Restart& restart);

/// Bring the checkpoint into the folder where the run goes on, if that is another: a run that
/// ends before its own first one can be restarted from there too. Returns where it is.
/// Collective.
std::filesystem::path bring_along(const std::filesystem::path& checkpoint,
                                  const std::filesystem::path& folder);

/// What the user should know: where the run goes on, what could not be read, what has
/// changed.
std::string report(const Restart& restart, const std::vector<CaseFile::Change>& changed);

} // namespace mergel::apps
