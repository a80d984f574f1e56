#include "dem/io/history.h"

#include "dem/error.h"

#include <array>
#include <charconv>
#include <cmath>

namespace mergel::dem {

std::string shortest(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

History::History(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)), columns_(columns), out_(file_)
{
  for (std::size_t c = 0; c < columns_.size(); ++c)
    out_ << (c == 0 ? "" : ",") << columns_[c];
  out_ << std::endl;
  if (!out_) throw NumericalError(file_.string() + ": cannot be written");
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
  out_ << line << std::endl;
  if (!out_)
    throw NumericalError(file_.string() +
                         ": cannot be written any further; is the disk full?");
}

} // namespace mergel::dem
