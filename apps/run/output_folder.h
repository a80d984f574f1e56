/// The results folder of a run: looked at first, changed once the input is known to be
/// good.
#pragma once

#include "apps/run/folder_lock.h"

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace mergel::apps {

/// Whether a folder that holds an earlier run may be used again.
enum class Earlier {
  keep,      ///< refuse such a folder
  overwrite, ///< remove what mergel wrote there, and nothing else
  begun,     ///< the same, but refuse a run that ended or has a checkpoint: it could go on
  go_on      ///< go on with that run: nothing is in the way
};

/// A folder for the results of one run.
///
/// mergel's own files in it, and the marks of an earlier run: history.csv, resolved.prm,
/// summary.json, failed.json, sample.h5, the four series particles, bonds, pile and
/// far_field (.pvd, and their numbered files in fields/), mergel-view's damage.png, load.png,
/// displacement.png, loads.png, surface.png, element.png, isotropic.png and curve.png, the
/// checkpoints checkpoint_*.h5 and *.h5.aside, .aside-2 and so on; also their temporary files
/// (dem/io/atomic_file.h). fields/ itself goes when nothing else is in it.
class OutputFolder {
public:
  OutputFolder(std::filesystem::path folder, Earlier earlier);

  const std::filesystem::path& path() const { return folder_; }

  /// The folder is locked already: before it was looked at.
  void hold(FolderLock lock) { lock_ = std::move(lock); }

  /// Refuse a folder that cannot be used; changes nothing on the disk.
  ///
  /// @param inputs files that the run reads later: they must not be among those that
  ///               commit() removes
  /// @throws InputError when something is in its way, it cannot be created or written, it
  ///   holds an earlier run that is to be kept, or one that is not only begun, another
  ///   run is writing there, or an input would be removed
  void check(const std::vector<std::filesystem::path>& inputs = {}) const;

  /// check() again, create the folder, keep other runs out of it while this object lives, and
  /// remove what an earlier run left.
  /// @throws InputError as above, or with the system's reason
  void commit(const std::vector<std::filesystem::path>& inputs = {});

  /// Remove what the earlier run wrote after a checkpoint, and what it left unfinished:
  /// frames from `n_frames` on, the summary, failed.json, temporary files. Checkpoints after `step` are
  /// set aside, whatever is wrong with them: checkpoint_<step>.h5.aside, or .aside-2 and so
  /// on where that is taken.
  /// @return the new names of these
  /// @throws NumericalError when one cannot be renamed
  std::vector<std::filesystem::path> cut_back(std::size_t n_frames,
                                              std::uint64_t step) const;

private:
  std::vector<std::filesystem::path> left_by_earlier_run() const;

  std::filesystem::path folder_;
  Earlier earlier_;
  FolderLock lock_; ///< from hold() or commit() on
};

/// What is in a folder of ours, for those who only look.
struct OwnFiles {
  std::vector<std::filesystem::path> files;  ///< by the names above; temporary ones too
  std::vector<std::filesystem::path> frames; ///< finished ones, in fields/
  std::vector<std::filesystem::path> aside;  ///< checkpoints set aside, among the files
};
OwnFiles own_files_in(const std::filesystem::path& folder);

} // namespace mergel::apps
