/// How often a cycle of loading is run: the end of the text of its stage,
/// "unload-reload to q = 0.2 MPa, 5 times".
#pragma once

#include "apps/case/words.h"
#include "dem/error.h"

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace mergel::apps {

/// Largest number of cycles of one stage: each has its own figures in the results. More are
/// further stages.
inline constexpr std::size_t most_cycles = 1000;

struct Cycles {
  std::string text; ///< of the stage, without the number
  std::size_t n = 1;
  bool is_given = false;
};

/// @throws InputError for a number out of range, or one that is written otherwise
inline Cycles cycles_in(const std::string& text)
{
  const std::string_view all = trimmed(text);
  const auto blank = all.find_last_of(" \t,");
  const std::string_view word = blank == all.npos ? all : all.substr(blank + 1);
  if (word != "times" && word != "time" && word != "cycles" && word != "cycle")
    return {text};
  const auto comma = all.find_last_of(',');
  if (comma == all.npos || !word.starts_with("time"))
    throw InputError("a number of cycles is written " + in_quotes(", 5 times") +
                     " at the end of the stage");
  const std::string_view number = trimmed(all.substr(comma + 1, blank - comma));
  const char* const end = number.data() + number.size();
  std::size_t n = 0;
  const auto [at, error] = std::from_chars(number.data(), end, n);
  if (error != std::errc{} || at != end || n < 1 || n > most_cycles)
    throw InputError("the number of cycles " + in_quotes(number) +
                     " must be a whole number from 1 to " + std::to_string(most_cycles) +
                     ", as in " + in_quotes(", 5 times") + "; more are further stages");
  return {std::string(trimmed(all.substr(0, comma))), n, true};
}

} // namespace mergel::apps
