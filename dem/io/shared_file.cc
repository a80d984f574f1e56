#include "dem/io/shared_file.h"

#include "dem/error.h"
#include "dem/io/seal.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <random>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mergel::dem {

namespace fs = std::filesystem;

namespace {

/// The mark is on a page that no rank writes to: a network file system writes whole pages,
/// with the rest of a page as it was read before.
constexpr std::uint64_t page = 65536;

constexpr std::chrono::milliseconds pause{100};
const char* const remedy = " Choose a folder with --output that all nodes share.";

[[noreturn]] void fail(const fs::path& file)
{
  const std::string reason = std::generic_category().message(errno);
  throw NumericalError(file.string() + ": cannot be written: " + reason);
}

/// A file open for reading, closed by the destructor.
struct Reader {
  explicit Reader(const fs::path& path) : number(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
  {
  }
  ~Reader()
  {
    if (number >= 0) ::close(number);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  int number;
};

/// Why the mark is not found; "" if it is.
std::string missing(const fs::path& path, const FileMark& mark)
{
  const Reader in(path);
  if (in.number < 0) return std::generic_category().message(errno);
  std::uint64_t value = 0;
  const ssize_t n = ::pread(in.number, &value, sizeof value, static_cast<off_t>(mark.at));
  if (n < 0) return std::generic_category().message(errno);
  return n == sizeof value && value == mark.value ? "" : "it finds another file";
}

} // namespace

Writer this_writer(const Communicator& comm)
{
  Writer w;
  w.rank = comm.rank();
  ::gethostname(w.host, sizeof w.host - 1);
  return w;
}

std::string name_of(const Writer& w)
{
  return "rank " + std::to_string(w.rank) + " on " + w.host;
}

SharedFile::SharedFile(const fs::path& path, const fs::path& final_name, Way way)
    : final_name_(final_name),
      number_(::open(path.c_str(),
                     O_WRONLY | O_CLOEXEC | (way == Way::make ? O_CREAT | O_EXCL : 0),
                     0666))
{
  if (number_ < 0) fail(final_name_);
}

SharedFile::~SharedFile()
{
  ::close(number_);
}

void SharedFile::require_room(std::size_t bytes, Size size)
{
  const int mode = size == Size::stays ? FALLOC_FL_KEEP_SIZE : 0;
  if (::fallocate(number_, mode, 0, static_cast<off_t>(bytes)) != 0 &&
      (errno == ENOSPC || errno == EFBIG || errno == EDQUOT))
    fail(final_name_);
}

FileMark SharedFile::mark(const Writer& maker)
{
  struct stat now = {};
  if (::fstat(number_, &now) != 0) fail(final_name_);
  FileMark m;
  m.end = static_cast<std::uint64_t>(now.st_size);
  m.at = (m.end / page + 1) * page;
  std::random_device any;
  do m.value = (std::uint64_t{any()} << 32) ^ any();
  while (m.value == 0); // a hole in a file reads as 0
  m.maker = maker;
  write({reinterpret_cast<const char*>(&m.value), sizeof m.value}, m.at);
  return m;
}

void SharedFile::remove_mark(const FileMark& mark)
{
  if (::ftruncate(number_, static_cast<off_t>(mark.end)) != 0) fail(final_name_);
}

void SharedFile::write(std::string_view bytes, std::uint64_t at)
{
  while (!bytes.empty()) {
    const ssize_t written =
        ::pwrite(number_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(final_name_);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

void SharedFile::flush()
{
  // EINVAL: this kind of file cannot be flushed.
  if (::fsync(number_) != 0 && errno != EINVAL) fail(final_name_);
}

void require_mark(const fs::path& path, const fs::path& final_name, const FileMark& mark,
                  const Writer& me, double timeout)
{
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout);
  for (;;) {
    const std::string wrong = missing(path, mark);
    if (wrong.empty()) return;
    if (std::chrono::steady_clock::now() >= end)
      throw NumericalError(
          final_name.string() + ": " + name_of(me) + " does not see the file that " +
          name_of(mark.maker) + " has made (" + wrong +
          "): its node has another folder of this name, or an old copy." + remedy);
    std::this_thread::sleep_for(pause);
    // A node may cache the list of a folder: opening the folder asks the server again.
    const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
    for (const fs::path& f : {folder, folder / ".."}) {
      std::error_code ignored;
      fs::directory_iterator(f, ignored);
    }
  }
}

const Piece* first_wrong(std::string_view bytes, const std::vector<Piece>& pieces)
{
  const auto found = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) {
    return p.at > bytes.size() || p.size > bytes.size() - p.at ||
           sum_of_words(bytes.substr(p.at, p.size)) != p.sum;
  });
  return found == pieces.end() ? nullptr : &*found;
}

std::string read_back(const fs::path& path, const fs::path& final_name,
                      const std::vector<Piece>& pieces)
{
  std::string bytes = bytes_of(path);
  const Piece* wrong = first_wrong(bytes, pieces);
  if (!wrong) return bytes;
  {
    const Reader in(path);
    ::posix_fadvise(in.number, 0, 0, POSIX_FADV_DONTNEED);
  }
  bytes = bytes_of(path);
  wrong = first_wrong(bytes, pieces);
  if (!wrong) return bytes;
  throw NumericalError(final_name.string() + ": what " + name_of(wrong->writer) +
                       " wrote did not arrive (bytes " + std::to_string(wrong->at) +
                       " to " + std::to_string(wrong->at + wrong->size) +
                       " differ): the disk or the network file system has lost them." +
                       remedy);
}

} // namespace mergel::dem
