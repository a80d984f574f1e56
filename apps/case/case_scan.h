/// The text of a case file: its keys, their values and lines.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::apps {

/// One `set key = value`.
struct CaseEntry {
  std::string section, key, value;
  int line = 0; ///< from 1; of the first line if it is continued
};

struct CaseScan {
  std::vector<CaseEntry> entries;      ///< in the order of the file, no key twice
  std::map<std::string, int> sections; ///< each section's first line
};

/// The text of a case file, with plain newlines and without a byte order mark.
/// A pipe can be read once only.
/// @throws InputError when it is missing, a folder, not readable, larger than 1 MB, or not text
std::string read_case_text(const std::filesystem::path& path);

/// Scan the text of a case file: values are those that deal.II's ParameterHandler reads.
///
/// @param name of the file, for messages
/// @throws InputError "name:line: ..." for a line that is none of subsection, set and end,
///         a section left open, opened in another or closed twice, and a key outside
///         sections or given twice
CaseScan scan_case(std::string_view text, const std::string& name);

/// The parts of one --set argument, "Section/key=value"; line 0.
/// @throws InputError when it has another form
CaseEntry scan_override(const std::string& argument);

} // namespace mergel::apps
