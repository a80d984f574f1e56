/// Checkpoint files: label and state of a run (apps/run/README.md, Checkpoints and
/// restart).
#pragma once

#include "dem/io/state/state_file.h"

#include <cstdint>

namespace mergel::dem {

/// Label of a checkpoint.
struct CheckpointLabel {
  std::string program;    ///< version that wrote it
  std::string job;        ///< "pile"
  std::string phase;      ///< of the job, in words
  std::string case_text;  ///< the complete case
  std::uint64_t step = 0; ///< since the start of the run
  double time = 0.0;      ///< since then [s]
};

struct Checkpoint {
  CheckpointLabel label;
  State state;
  std::uint64_t sum = 0; ///< checksum of the file that it was read from
};

/// File name of the checkpoint of this step; names ascend with steps.
std::string checkpoint_name(std::uint64_t step);
/// True for a name that checkpoint_name() gives.
bool is_checkpoint_name(const std::filesystem::path& name);
/// True when a is the name of a later step than b.
bool is_later(const std::filesystem::path& a, const std::filesystem::path& b);

/// Write the label and `mine`, the part of this rank; see write_state().
void write_checkpoint(const std::filesystem::path& file, const CheckpointLabel& label,
                      State mine, const Communicator& comm);

/// Needs no MPI. Throws as read_state().
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// The checkpoints of a folder, the newest first; none if there is no such folder.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

/// Of the checkpoints up to the one just written, remove all but the newest `n`. Files that
/// cannot be removed stay, and so do checkpoints of later steps.
void keep_newest(const std::filesystem::path& written, std::size_t n);

/// A checkpoint that cannot be read.
struct RefusedCheckpoint {
  std::filesystem::path file;
  std::string reason;
  bool is_damaged; ///< truncated or changed; else another user or program may read it
  bool is_of_other_version = false; ///< another version of mergel reads it
};

/// A checkpoint that can be read, and why newer ones in its folder cannot.
struct FoundCheckpoint {
  std::filesystem::path file; ///< empty: none can be read
  Checkpoint checkpoint;
  std::vector<RefusedCheckpoint> refused; ///< the newest first
};

/// The newest checkpoint of a folder that can be read.
FoundCheckpoint newest_checkpoint(const std::filesystem::path& folder);

} // namespace mergel::dem
