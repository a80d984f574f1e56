#include "dem/io/atomic_file.h"

#include "dem/error.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace mergel::dem {

namespace fs = std::filesystem;

namespace {

/// Reads errno: call it before anything else can change it.
[[noreturn]] void fail(const fs::path& file)
{
  const std::string reason = std::generic_category().message(errno);
  throw NumericalError(
      file.string() + ": cannot be written: " + reason +
      ". Check that the folder exists, its permissions, and the free space "
      "and quota of the disk.");
}

/// An open file, closed by the destructor; errors name `file`, not the temporary name.
class Descriptor {
public:
  Descriptor(const fs::path& path, int flags, const fs::path& file)
      : file_(file), number_(::open(path.c_str(), flags | O_CLOEXEC, 0666))
  {
    if (number_ < 0) fail(file_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor()
  {
    if (number_ >= 0) ::close(number_);
  }

  void write(std::string_view bytes)
  {
    while (!bytes.empty()) {
      const ssize_t written = ::write(number_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(file_);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// The last chance to detect a failed write: some file systems report a full disk only
  /// now.
  void flush_and_close()
  {
    // EINVAL: this kind of file cannot be flushed.
    if (::fsync(number_) != 0 && errno != EINVAL) fail(file_);
    const int number = number_;
    number_ = -1;
    if (::close(number) != 0) fail(file_);
  }

private:
  const fs::path file_;
  int number_;
};

/// Removes the temporary file, unless it has been renamed.
class TemporaryFileGuard {
public:
  explicit TemporaryFileGuard(fs::path path) : path_(std::move(path)) {}
  TemporaryFileGuard(const TemporaryFileGuard&) = delete;
  TemporaryFileGuard& operator=(const TemporaryFileGuard&) = delete;
  ~TemporaryFileGuard()
  {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

private:
  fs::path path_;
};

} // namespace

fs::path temporary_name(const fs::path& file)
{
  std::string name = ".";
  name += file.stem().string();
  name += ".partial";
  name += file.extension().string();
  return file.parent_path() / name;
}

void replace_file(const fs::path& file, const std::function<void(const fs::path&)>& write)
{
  const fs::path temporary = temporary_name(file);
  const TemporaryFileGuard leftover(temporary);
  write(temporary);
  Descriptor(temporary, O_RDONLY, file).flush_and_close();
  if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file);
  // The new name is on the disk only after its folder is flushed.
  const fs::path folder = file.parent_path().empty() ? "." : file.parent_path();
  Descriptor(folder, O_RDONLY | O_DIRECTORY, file).flush_and_close();
}

void replace_file(const fs::path& file, std::string_view bytes)
{
  replace_file(file, [&](const fs::path& temporary) {
    Descriptor out(temporary, O_WRONLY | O_CREAT | O_TRUNC, file);
    out.write(bytes);
    out.flush_and_close();
  });
}

} // namespace mergel::dem
