/// The results folder of a run: checked first, changed only once the input is known to be
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
  begun,     ///< as overwrite, but refuse a run that finished, failed or has a checkpoint
  go_on      ///< continue that run
};

/// Whether a folder holds a run of mergel, finished or not: a resolved case that mergel
/// wrote, a checkpoint, or a file that a killed run could not rename. Files of the user may
/// have the names of mergel's (history.csv): names alone do not tell.
bool holds_run(const std::filesystem::path& folder);

/// A folder for the results of one run.
///
/// mergel's own files, which mark an earlier run, are history.csv, localisation.csv,
/// resolved.prm, summary.json, failed.json, sample.h5, the series particles, bonds, pile,
/// far_field, platens, membrane, breaks and plates (.pvd, and their numbered files in
/// fields/), mergel-view's damage.png, load.png, displacement.png, loads.png, surface.png,
/// element.png, triaxial.png, specimen.png, localisation.png, isotropic.png, brazilian.png,
/// disc.png, compare.png and curve.png, the checkpoints checkpoint_*.h5 and *.h5.aside,
/// .aside-2 and so on; also their temporary files (dem/io/atomic_file.h).
/// fields/ itself is removed when it is empty. They are removed only from a folder that
/// holds a run (holds_run()), or the lock of one that was killed.
class OutputFolder {
public:
  OutputFolder(std::filesystem::path folder, Earlier earlier);

  const std::filesystem::path& path() const { return folder_; }

  /// Take a lock that was obtained before the folder was checked.
  void hold(FolderLock lock) { lock_ = std::move(lock); }

  /// Refuse a folder that cannot be used; changes nothing on the disk.
  ///
  /// @param inputs files that the run reads later: they must not be among those that
  ///               commit() removes
  /// @throws InputError when its name is taken by a file, it cannot be created or written,
  ///   it holds an earlier run that may not be removed (see Earlier), files of these names
  ///   that no run has left, or beside a run a .png that mergel-view has not made, another
  ///   run is writing there, or an input would be removed
  void check(const std::vector<std::filesystem::path>& inputs = {}) const;

  /// check() again, create the folder, lock it while this object lives, and remove the
  /// files of an earlier run.
  /// @throws InputError as above, or with the system's reason
  void commit(const std::vector<std::filesystem::path>& inputs = {});

  /// Remove what the earlier run wrote after a checkpoint, and its unfinished files: frames
  /// from `n_frames` on, the summary, failed.json, temporary files. Checkpoints after
  /// `step` are set aside, damaged or not: they become checkpoint_<step>.h5.aside, or
  /// .aside-2 and so on where that name is taken.
  /// @return the new names of these checkpoints
  /// @throws NumericalError when one cannot be renamed
  std::vector<std::filesystem::path> remove_after(std::size_t n_frames,
                                                  std::uint64_t step) const;

private:
  bool is_of_run() const;
  void check(const std::vector<std::filesystem::path>& inputs, bool is_of_run) const;
  std::vector<std::filesystem::path> left_by_earlier_run() const;

  std::filesystem::path folder_;
  Earlier earlier_;
  FolderLock lock_; ///< from hold() or commit() on
};

/// mergel's files in a results folder.
struct OwnFiles {
  std::vector<std::filesystem::path> files;  ///< names as above; temporary ones too
  std::vector<std::filesystem::path> frames; ///< finished ones, in fields/
  std::vector<std::filesystem::path> aside;  ///< checkpoints set aside, among the files
};
/// @throws InputError when the folder, or fields/ in it, cannot be read
OwnFiles own_files_in(const std::filesystem::path& folder);

} // namespace mergel::apps
