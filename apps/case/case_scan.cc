#include "apps/case/case_scan.h"

#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/text.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <system_error>
#include <utility>

namespace mergel::apps {

namespace {

/// Whether the line starts with the keyword and a blank; `rest` is then what follows.
bool read_keyword(std::string_view line, std::string_view lower, std::string_view upper,
                  std::string_view& rest)
{
  if (!line.starts_with(lower) && !line.starts_with(upper)) return false;
  rest = line.substr(lower.size());
  if (!rest.empty() && rest.front() != ' ') return false;
  rest = trimmed(rest);
  return true;
}

/// Reads lines one after the other and keeps track of the open section.
class Scanner {
public:
  explicit Scanner(const std::string& name) : name_(name) {}

  void take(std::string text, int number)
  {
    std::replace(text.begin(), text.end(), '\t', ' '); // as ParameterHandler does
    const std::string_view line = trimmed(std::string_view(text).substr(0, text.find('#')));
    line_ = number;
    std::string_view rest;
    if (line.empty()) return;
    if (read_keyword(line, "subsection", "SUBSECTION", rest))
      open(rest);
    else if (read_keyword(line, "end", "END", rest))
      close(rest);
    else if (read_keyword(line, "set", "SET", rest))
      set(rest);
    else
      fail(in_quotes(line) +
           " is not understood. Write \"subsection NAME\", \"set KEY = VALUE\" or \"end\"");
  }

  CaseScan finish()
  {
    if (!section_.empty()) {
      line_ = opened_;
      fail("subsection " + in_quotes(section_) +
           " is never closed. Write \"end\" after its last key");
    }
    return std::move(scan_);
  }

private:
  [[noreturn]] void fail(const std::string& message) const
  {
    throw InputError(name_ + ":" + std::to_string(line_) + ": " + message + ".");
  }

  void open(std::string_view section)
  {
    if (section.empty()) fail("subsection without a name");
    if (!section_.empty())
      fail("subsection " + in_quotes(section) + " opens inside " + in_quotes(section_) +
           " of line " + std::to_string(opened_) + ". Write \"end\" before it");
    section_ = section;
    opened_ = line_;
    scan_.sections.emplace(section_, line_);
  }

  void close(std::string_view rest)
  {
    if (!rest.empty())
      fail(in_quotes(rest) + " after \"end\". Put it in a line of its own");
    if (section_.empty()) fail("\"end\" without a subsection to close. Remove it");
    section_.clear();
  }

  void set(std::string_view rest)
  {
    const auto equals = rest.find('=');
    if (equals == std::string_view::npos)
      fail(in_quotes("set " + std::string(rest)) +
           " has no \"=\". Write \"set KEY = VALUE\"");
    CaseEntry entry{section_, std::string(trimmed(rest.substr(0, equals))),
                    std::string(trimmed(rest.substr(equals + 1))), line_};
    if (entry.key.empty()) fail("\"set\" without a key. Write \"set KEY = VALUE\"");
    if (section_.empty())
      fail(entry.key + " = " + entry.value +
           ": stands outside the sections. Put it between \"subsection NAME\" and \"end\"");
    const auto earlier = std::find_if(
        scan_.entries.begin(), scan_.entries.end(), [&](const CaseEntry& other) {
          return other.section == entry.section && other.key == entry.key;
        });
    if (earlier != scan_.entries.end())
      fail(entry.section + "/" + entry.key + " = " + entry.value +
           ": already set in line " + std::to_string(earlier->line) +
           ". Keep one of the two");
    scan_.entries.push_back(std::move(entry));
  }

  const std::string& name_;
  CaseScan scan_;
  std::string section_; ///< open now; empty for none
  int opened_ = 0, line_ = 0;
};

} // namespace

CaseScan scan_case(std::string_view text, const std::string& name)
{
  Scanner scanner(name);
  std::string joined; // lines so far of one that is continued by '\'
  int number = 0, first = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (first == 0) first = number;

    const bool is_continued = line.ends_with('\\');
    if (is_continued) line.remove_suffix(1);
    joined += line;
    if (is_continued && !text.empty()) continue;
    scanner.take(std::exchange(joined, {}), first);
    first = 0;
  }
  return scanner.finish();
}

std::string read_case_text(const std::filesystem::path& path)
{
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(name + ": no such case file. Check its name and the working folder.");
  if (std::filesystem::is_directory(status))
    throw InputError(name + ": is a folder, not a case file. Name a .prm file.");

  constexpr std::size_t largest = 1 << 20; // a case has a few kB; a device has no end
  std::string content(largest + 1, '\0');
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (stream.is_open())
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (!stream.is_open() || stream.bad() || errno != 0)
    throw InputError(name + ": cannot be read (" +
                     std::generic_category().message(errno != 0 ? errno : EIO) +
                     "). Check its permissions.");
  content.resize(static_cast<std::size_t>(stream.gcount()));
  if (content.size() > largest)
    throw InputError(name + ": is larger than 1 MB and no case file. Name a .prm file.");
  try {
    content = dem::plain_text(std::move(content));
  } catch (const InputError& e) {
    throw InputError(name + ": " + e.what());
  }
  if (content.find('\0') != std::string::npos)
    throw InputError(name + ": is no text file. Name a .prm file.");
  return content;
}

CaseEntry scan_override(const std::string& argument)
{
  const auto equals = argument.find('=');
  const auto slash = argument.find('/');
  if (equals == std::string::npos || slash == std::string::npos || slash > equals)
    throw InputError("--set \"" + argument +
                     "\": is not understood. Write --set \"Section/key=value\".");
  const std::string_view view = argument;
  CaseEntry entry{std::string(trimmed(view.substr(0, slash))),
                  std::string(trimmed(view.substr(slash + 1, equals - slash - 1))),
                  std::string(trimmed(view.substr(equals + 1))), 0};
  return entry;
}

} // namespace mergel::apps
