#include "dem/io/history.h"

#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/seal.h"
#include "dem/text.h"

#include <cerrno>
#include <cmath>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace mergel::dem {

namespace {

/// The part of a history before the mark.
std::string begun(const std::filesystem::path& file, const HistoryMark& mark)
{
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? std::streamoff(in.tellg()) : -1;
  std::string text;
  if (size >= 0 && mark.bytes <= static_cast<std::uint64_t>(size)) {
    text.resize(mark.bytes);
    in.seekg(0);
    in.read(text.data(), static_cast<std::streamsize>(mark.bytes));
  }
  require(in.good() && text.size() == mark.bytes && fnv_1a(text) == mark.sum,
          file.string() +
              (size < 0 ? ": is missing"
                        : ": does not begin as it did when the checkpoint was written") +
              ", so it cannot be continued. Put it back beside the checkpoint.");
  return text;
}

} // namespace

void check_history(const std::filesystem::path& file, const HistoryMark& mark)
{
  begun(file, mark);
}

History::History(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)), columns_(columns)
{
  open(std::ios::trunc);
  mark_.sum = fnv_1a("");
  std::string header;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    header += (c == 0 ? "" : ",") + columns_[c];
  write(header);
}

History::History(std::filesystem::path file, const std::vector<std::string>& columns,
                 const std::filesystem::path& earlier, const HistoryMark& mark)
    : file_(std::move(file)), columns_(columns), mark_(mark)
{
  replace_file(file_, begun(earlier, mark));
  open(std::ios::app);
}

void History::open(std::ios::openmode mode)
{
  errno = 0; // some failures of a stream do not set it
  out_.open(file_, std::ios::binary | std::ios::out | mode);
  if (out_) return;
  const std::string reason = errno == 0 ? "" : std::generic_category().message(errno);
  throw NumericalError(file_.string() + ": cannot be written" +
                       (reason.empty() ? "" : ": " + reason) +
                       ". Check that the folder exists and its permissions.");
}

void History::write(const std::string& line)
{
  const std::string text = line + '\n';
  out_ << text << std::flush;
  if (!out_)
    throw NumericalError(file_.string() +
                         ": cannot be written any further; is the disk full?");
  mark_.bytes += text.size();
  mark_.sum = fnv_1a(text, mark_.sum);
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
  const int number = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool failed = number < 0 || (::fsync(number) != 0 && errno != EINVAL);
  const std::string reason = std::generic_category().message(errno);
  if (number >= 0) ::close(number);
  if (failed)
    throw NumericalError(file_.string() + ": cannot be flushed to the disk: " + reason);
  return mark_;
}

} // namespace mergel::dem
