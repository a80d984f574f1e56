/// What the resolved case of a run tells of its test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mergel::apps {

struct TestCase {
  /// The loading stages, one for each key, as the history numbers them.
  std::vector<std::string> stages;
  /// The keys named `seed`, "Section/seed=1". Runs with other seeds and all other keys alike
  /// are realisations of one test.
  std::string seeds;
  /// All other keys with a value, but Specimen/file: a specimen file is refused unless it was made
  /// by the keys of its run, the seed among them.
  std::string other_keys;
};

/// @param text of a resolved.prm; @param name of it, for messages
/// @throws InputError naming the line that cannot be read
TestCase test_case_of(const std::string& text, const std::string& name);

/// That of a results folder. @throws InputError when its resolved.prm cannot be read
TestCase read_test_case(const std::filesystem::path& folder);

} // namespace mergel::apps
