#include "apps/case/walltime.h"

#include "apps/case/units.h"
#include "dem/error.h"

#include <charconv>
#include <limits>
#include <vector>

namespace mergel::apps {

namespace {

/// [hours:]minutes:seconds, or days-hours[:minutes[:seconds]] [s]; NaN for what is neither.
double read_clock(const std::string& text)
{
  constexpr double wrong = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> parts;
  bool has_days = false;
  for (const char *at = text.data(), *const end = at + text.size();; ++at) {
    unsigned part = 0;
    const auto read = std::from_chars(at, end, part);
    if (read.ec != std::errc{}) return wrong;
    parts.push_back(part);
    at = read.ptr;
    if (at == end) break;
    if (*at == '-' && parts.size() == 1)
      has_days = true;
    else if (*at != ':')
      return wrong;
  }
  if (parts.size() > (has_days ? 4 : 3)) return wrong;
  double seconds = 0.0;
  if (has_days) {
    parts.resize(4); // what is left out is 0
    parts[1] += 24.0 * parts[0];
    parts[0] = 0.0;
  }
  for (const double part : parts) seconds = 60.0 * seconds + part;
  return seconds;
}

} // namespace

double to_walltime(const std::string& text)
{
  const InputError wrong(
      "mergel: --walltime " + text +
      ": is not a time above 0; expected for example \"4 h\", \"30 min\", \"4:00:00\" or "
      "\"1-12:00:00\"");
  const bool is_clock = text.find_first_of(":-") != std::string::npos &&
                        text.find_first_not_of("0123456789:-") == std::string::npos;
  double seconds = 0.0;
  try {
    seconds = is_clock ? read_clock(text) : to_si(text, "s");
  } catch (const InputError&) {
    throw wrong;
  }
  if (!(seconds > 0.0)) throw wrong;
  return seconds;
}

} // namespace mergel::apps
