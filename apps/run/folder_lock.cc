#include "apps/run/folder_lock.h"

#include "dem/error.h"
#include "dem/io/readable.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

const char* const lock_name = ".mergel.lock";
constexpr std::string_view first_words = "process "; // of what a lock file holds
constexpr std::chrono::milliseconds pause{100};

[[noreturn]] void refuse(const fs::path& folder, const std::string& holder)
{
  throw InputError("output folder " + folder.string() + ": " + holder +
                   " is writing there. Wait for it to end, end it, or choose another "
                   "folder with --output.");
}

/// An open file, closed by the destructor.
struct Descriptor {
  int number;
  ~Descriptor()
  {
    if (number >= 0) ::close(number);
  }
};

enum class Locked { yes, no, unknown };

Locked lock(int number)
{
  while (::flock(number, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return Locked::no;
    if (errno != EINTR) return Locked::unknown; // no locks on this file system
  }
  return Locked::yes;
}

/// Whether the open file is still the one of this name: the run before may have removed it.
bool is_at(int number, const fs::path& file)
{
  struct stat mine = {}, there = {};
  return ::fstat(number, &mine) == 0 && ::stat(file.c_str(), &there) == 0 &&
         mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

std::string this_process()
{
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return std::string(first_words) + std::to_string(::getpid()) + " on " + host.data();
}

std::string who(int number)
{
  std::array<char, 400> text{};
  const ssize_t n = ::pread(number, text.data(), text.size() - 1, 0);
  return n > 0 ? "another run (" + std::string(text.data()) + ")" : "another run";
}

} // namespace

FolderLock::FolderLock(const fs::path& folder, double timeout) : file_(folder / lock_name)
{
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout);
  for (;;) {
    Descriptor file{::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)};
    if (file.number < 0)
      throw InputError("output folder " + folder.string() +
                       ": cannot be written: " + std::generic_category().message(errno) +
                       " at " + file_.string() + ". Choose another folder with --output.");
    switch (lock(file.number)) {
    case Locked::unknown:
      std::cerr
          << folder.string() << ": " << std::generic_category().message(errno)
          << ": this file system has no locks: make sure that no other run writes there"
          << std::endl;
      return;
    case Locked::no:
      if (std::chrono::steady_clock::now() >= end) refuse(folder, who(file.number));
      break;
    case Locked::yes: {
      if (!is_at(file.number, file_)) continue;
      number_ = std::exchange(file.number, -1);
      // Only information for other runs: on a full disk the lock holds without it.
      const std::string me = this_process();
      if (::ftruncate(number_, 0) == 0) [[maybe_unused]]
        const ssize_t n = ::pwrite(number_, me.data(), me.size(), 0);
      return;
    }
    }
    std::this_thread::sleep_for(pause);
  }
}

FolderLock::~FolderLock()
{
  if (number_ < 0) return;
  ::unlink(file_.c_str()); // while it is locked: no other run holds this name
  ::close(number_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::exchange(other.file_, {})), number_(std::exchange(other.number_, -1))
{
}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept
{
  std::swap(file_, other.file_);
  std::swap(number_, other.number_);
  return *this;
}

bool FolderLock::is_known(const fs::path& folder)
{
  return dem::begins_with(folder / lock_name, first_words);
}

std::string FolderLock::holder(const fs::path& folder)
{
  const Descriptor file{::open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC)};
  if (file.number < 0 || lock(file.number) != Locked::no) return "";
  return who(file.number);
}

void require_no_run(const fs::path& folder, double timeout)
{
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout);
  for (;;) {
    const std::string holder = FolderLock::holder(folder);
    if (holder.empty()) return;
    if (std::chrono::steady_clock::now() >= end) refuse(folder, holder);
    std::this_thread::sleep_for(pause);
  }
}

} // namespace mergel::apps
