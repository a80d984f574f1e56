#include "apps/run/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

namespace mergel::apps {

namespace {

constexpr double terminal_interval = 0.2, file_interval = 10.0; // [s]
constexpr double settling = 2.0;                                // no estimate before [s]

} // namespace

std::string duration_text(double seconds)
{
  if (!(seconds > 0.0)) return "0 s";
  const auto s = std::llround(std::min(seconds, 1e12));
  const auto two = [](long long a, const char* a_unit, long long b, const char* b_unit) {
    std::string text = std::to_string(a) + " " + a_unit;
    if (b > 0) text.append(" ").append(std::to_string(b)).append(" ").append(b_unit);
    return text;
  };
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return two(s / 60, "min", s % 60, "s");
  if (s < 86400) return two(s / 3600, "h", s % 3600 / 60, "min");
  return two(s / 86400, "d", s % 86400 / 3600, "h");
}

ProgressOutput ProgressOutput::standard()
{
  ProgressOutput output;
  output.out = &std::cout;
  // mpirun gives its ranks a terminal without a width, and what it forwards may go to a file.
  winsize window{};
  const bool has_width =
      ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 1;
  output.is_terminal = isatty(STDOUT_FILENO) != 0 && has_width;
  if (has_width) output.columns = window.ws_col - 1u;
  output.clock = [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  };
  return output;
}

Progress::Progress(std::string phase, ProgressOutput output)
    : phase_(std::move(phase)), output_(std::move(output)), start_(output_.clock()),
      shown_(start_), measured_(start_), advanced_(start_)
{
}

Progress::~Progress()
{
  if (line_length_ > 0) *output_.out << std::endl;
}

void Progress::update(double fraction, const std::function<std::string()>& detail)
{
  const double now = output_.clock();
  if (now - shown_ < (output_.is_terminal ? terminal_interval : file_interval)) return;
  shown_ = now;
  // What a growing pressure loosens again, or another rank has not reached, is no progress.
  fraction = std::max(fraction, measured_fraction_);

  const double elapsed = now - start_, interval = now - measured_;
  const double window = std::max(10.0, 0.1 * elapsed);
  // Until the window is full, the mean rate since the start is the estimate; smoothing
  // starts from it.
  if (elapsed <= window)
    rate_ = fraction / elapsed;
  else
    rate_ += (1.0 - std::exp(-interval / window)) *
             ((fraction - measured_fraction_) / interval - rate_);
  if (fraction > measured_fraction_) advanced_ = now;
  measured_ = now;
  measured_fraction_ = fraction;

  char percent[32];
  std::snprintf(percent, sizeof percent, "%5.1f %%",
                100.0 * std::clamp(fraction, 0.0, 1.0));
  std::string line = phase_ + "  " + percent;
  if (const std::string text = detail(); !text.empty()) line += "  " + text;
  const bool moves_on = now - advanced_ < file_interval;
  if (elapsed >= settling && rate_ > 0.0 && fraction < 1.0 && moves_on)
    line += "  " + duration_text((1.0 - fraction) / rate_) + " left";
  show(line);
}

void Progress::update(double fraction, const std::string& detail)
{
  update(fraction, [&] { return detail; });
}

void Progress::say(const std::string& lines)
{
  if (lines.empty()) return;
  if (line_length_ > 0) *output_.out << '\r' << std::string(line_length_, ' ') << '\r';
  *output_.out << lines << std::flush;
  line_length_ = 0;
}

void Progress::done(const std::string& detail)
{
  const std::string line = phase_ + "  done  " + (detail.empty() ? "" : detail + "  ") +
                           "in " + duration_text(output_.clock() - start_);
  say(line + "\n"); // nothing overwrites it: it may wrap
}

void Progress::show(const std::string& line)
{
  if (!output_.is_terminal) {
    *output_.out << line << std::endl;
    return;
  }
  std::string text = line.substr(0, output_.columns);
  const std::size_t length = text.size();
  text.resize(std::max(length, line_length_), ' '); // overwrite the rest of a longer line
  *output_.out << '\r' << text << std::flush;
  line_length_ = length;
}

} // namespace mergel::apps
