/// Parsing of what follows the name of a job.
#pragma once

#include "apps/case/words.h"
#include "dem/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace mergel::apps {

/// @param command "mergel pile", for the message
/// @throws InputError, or CLI::CallForHelp
inline void parse(CLI::App& app, const std::string& command,
                  std::vector<std::string> arguments)
{
  try {
    std::reverse(arguments.begin(), arguments.end()); // CLI11 takes the last one first
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    throw;
  } catch (const CLI::ParseError& error) {
    throw InputError(command + ": " + in_one_line(error.what()) + ". See " + command +
                     " --help.");
  }
}

} // namespace mergel::apps
