#include "dem/io/history.h"

#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/readable.h"
#include "dem/io/seal.h"
#include "dem/text.h"

#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mergel::dem {

namespace {

/// First line of a history that begins at a mark, because what was before it is missing.
std::string remark_on(const HistoryMark& mark)
{
  return "# begins behind " + std::to_string(mark.bytes) + " bytes of checksum " +
         hexadecimal(mark.sum) + ", which are missing";
}

/// The part of a history before the mark; of one that begins there its first two lines.
std::string begun(const std::filesystem::path& file, const HistoryMark& mark)
{
  require_readable(file);
  std::ifstream in(file, std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), {});
  const std::string remark = remark_on(mark) + '\n';
  const auto heading = all.find('\n', remark.size());
  if (all.starts_with(remark) && heading != std::string::npos)
    return all.substr(0, heading + 1);
  std::string text = all.substr(0, mark.bytes);
  require(text.size() == mark.bytes && fnv_1a(text) == mark.sum,
          file.string() +
              ": does not begin as it did when the checkpoint was written, so it cannot be "
              "continued. Put back what it was, or move it away: the history then begins "
              "at the checkpoint.");
  return text;
}

bool is_missing(const std::filesystem::path& file)
{
  std::error_code error; // a file that cannot be reached is refused where it is read
  return std::filesystem::status(file, error).type() ==
         std::filesystem::file_type::not_found;
}

} // namespace

bool check_history(const std::filesystem::path& file, const HistoryMark& mark)
{
  if (is_missing(file)) return false;
  begun(file, mark);
  return true;
}

History::History(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)), columns_(columns)
{
  begin("");
}

void History::begin(const std::string& remark)
{
  open(O_CREAT | O_TRUNC);
  mark_ = {0, fnv_1a("")};
  if (!remark.empty()) write(remark);
  std::string header;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    header += (c == 0 ? "" : ",") + columns_[c];
  write(header);
}

History::History(std::filesystem::path file, const std::vector<std::string>& columns,
                 const std::filesystem::path& earlier, const HistoryMark& mark)
    : file_(std::move(file)), columns_(columns)
{
  if (is_missing(earlier)) {
    begin(remark_on(mark));
    return;
  }
  const std::string text = begun(earlier, mark);
  mark_ = {text.size(), fnv_1a(text)};
  replace_file(file_, text);
  open(0);
}

History::~History()
{
  if (number_ >= 0) ::close(number_);
}

History::History(History&& other) noexcept
    : file_(std::move(other.file_)), columns_(std::move(other.columns_)),
      number_(std::exchange(other.number_, -1)), mark_(other.mark_)
{
}

void History::open(int flags)
{
  number_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | flags, 0666);
  if (number_ >= 0) return;
  throw NumericalError(file_.string() +
                       ": cannot be written: " + std::generic_category().message(errno) +
                       ". Check that the folder exists and its permissions.");
}

void History::write(const std::string& line)
{
  const std::string text = line + '\n';
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t written = ::write(number_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw NumericalError(file_.string() + ": cannot be written any further: " +
                           std::generic_category().message(errno));
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  mark_.bytes += text.size();
  mark_.sum = fnv_1a(text, mark_.sum);
  require_in_place();
}

void History::require_in_place() const
{
  struct stat mine = {}, there = {};
  if (::fstat(number_, &mine) != 0 || ::stat(file_.c_str(), &there) != 0)
    throw NumericalError(
        file_.string() + ": was removed, renamed or moved while the run wrote it (" +
        std::generic_category().message(errno) + "): the records that it held are lost");
  if (mine.st_dev != there.st_dev || mine.st_ino != there.st_ino)
    throw NumericalError(
        file_.string() +
        ": was replaced by another file while the run wrote it, as an editor does that "
        "saves it: the records since then are lost");
  if (static_cast<std::uint64_t>(mine.st_size) != mark_.bytes)
    throw NumericalError(file_.string() + ": has " + std::to_string(mine.st_size) +
                         " bytes where the run wrote " + std::to_string(mark_.bytes) +
                         ": another program has changed it, and its records are lost");
}

void History::add(const std::vector<double>& values)
{
  std::string line;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (!std::isfinite(values[c]))
      throw NumericalError("\"" + columns_[c] + "\" is not a number: the run is unstable");
    if (c > 0) line += ',';
    line += shortest(values[c]);
  }
  write(line);
}

HistoryMark History::mark() const
{
  require_in_place();
  if (::fsync(number_) != 0 && errno != EINVAL)
    throw NumericalError(file_.string() + ": cannot be flushed to the disk: " +
                         std::generic_category().message(errno));
  return mark_;
}

} // namespace mergel::dem
