/// The text of a case that mergel ships, without some of its keys.
#pragma once

#include "tests/support/repository.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace mergel::test {

/// @param name "pile_small.prm"
inline std::string without(const char* name, const std::vector<std::string>& keys)
{
  std::ifstream in(repository() / "apps/cases" / name);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    const auto sets = [&](const std::string& key) {
      const auto at = line.find("set " + key);
      return at != std::string::npos &&
             line.find_first_not_of(' ', at + 4 + key.size()) == line.find('=');
    };
    if (std::none_of(keys.begin(), keys.end(), sets)) text += line + "\n";
  }
  return text;
}

} // namespace mergel::test
