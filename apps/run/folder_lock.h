/// One run at a time in a results folder.
#pragma once

#include <filesystem>
#include <string>

namespace mergel::apps {

/// Keeps the file `.mergel.lock` of a folder locked (flock) while the object lives, and
/// removes the file at the end. A file that a killed run has left behind locks nothing: the
/// system releases the lock with the process.
///
/// On NFS the server keeps the lock, for all nodes; when a node dies, it keeps it until the
/// lease ends, 90 s as a rule. On a file system without locks the folder is not locked, and
/// a warning is printed.
class FolderLock {
public:
  FolderLock() = default; ///< locks nothing
  /// @param timeout longest wait for a run that is just ending [s]
  /// @throws InputError naming the run that holds it, or when the file cannot be created
  explicit FolderLock(const std::filesystem::path& folder, double timeout = 5.0);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  /// True also where the file system has no locks.
  bool is_held() const { return !file_.empty(); }

  /// Whether the folder has a lock file that names a process: a run writes there, or was
  /// killed. An empty file of this name proves nothing.
  static bool is_known(const std::filesystem::path& folder);
  /// Description of the run that holds the folder; "" when none does. Creates no file.
  static std::string holder(const std::filesystem::path& folder);

private:
  std::filesystem::path file_;
  int number_ = -1;
};

/// Refuse a folder where a run is still writing after `timeout` [s]. Creates no file.
/// @throws InputError naming that run
void require_no_run(const std::filesystem::path& folder, double timeout = 5.0);

} // namespace mergel::apps
