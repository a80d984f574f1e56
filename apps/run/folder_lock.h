/// One run at a time in a results folder.
#pragma once

#include <filesystem>
#include <string>

namespace mergel::apps {

/// Holds the file `.mergel.lock` of a folder locked (flock) while it lives, and removes it at
/// the end. A file that a killed run has left behind locks nothing: the system drops the
/// lock with the process.
///
/// On NFS the lock is the server's and holds on all nodes; when a node dies the server keeps
/// it for its lease, 90 s as a rule. A file system without locks is used without, and the
/// user is told.
class FolderLock {
public:
  FolderLock() = default; ///< of no folder
  /// @param patience how long a run that is just ending is waited for [s]
  /// @throws InputError naming the run that holds it; when the file cannot be made
  explicit FolderLock(const std::filesystem::path& folder, double patience = 5.0);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  /// True also where the file system has no locks.
  bool is_held() const { return !file_.empty(); }

  /// Whether a run has been in the folder, and holds it or was killed.
  static bool is_known(const std::filesystem::path& folder);
  /// The run that holds the folder, in words; "" when none does. Makes no file.
  static std::string holder(const std::filesystem::path& folder);

private:
  std::filesystem::path file_;
  int number_ = -1;
};

/// Refuse a folder where a run is still writing after `patience` [s]. Makes no file.
/// @throws InputError naming that run
void require_no_run(const std::filesystem::path& folder, double patience = 5.0);

} // namespace mergel::apps
