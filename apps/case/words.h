/// Text of messages: trimmed, joined, quoted, wrapped, and the known word nearest to
/// another.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::apps {

/// `text` without white space at both ends.
inline std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view white = " \t\r\n\f\v";
  const auto first = text.find_first_not_of(white);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white) - first + 1);
}

/// The words with `between` between them.
inline std::string joined(const std::vector<std::string>& words, const std::string& between)
{
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// "text" in double quotes.
inline std::string in_quotes(std::string_view text)
{
  std::string result = "\""; // in steps: GCC 12 sees an overlap in a sum that starts so
  result += text;
  result += "\"";
  return result;
}

/// The words of `text` in lines of at most `width` columns, each starting with `indent` and
/// ending in a newline; only a longer word makes a longer line.
inline std::string wrapped(const std::string& text, const std::string& indent,
                           std::size_t width)
{
  std::istringstream words(text);
  std::string result, line = indent, word;
  while (words >> word) {
    if (line.size() > indent.size() && line.size() + 1 + word.size() > width) {
      result += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
  }
  return result + line + "\n";
}

/// The text of an exception in one line. deal.II's are many lines: banner rules and the
/// stack trace are left out. A text without newlines stays as it is.
inline std::string in_one_line(std::string text)
{
  if (text.empty()) return "no message";
  if (text.find('\n') == std::string::npos) return text;
  text.erase(std::min(text.find("Stacktrace"), text.size()));
  std::istringstream words(text);
  std::vector<std::string> kept;
  for (std::string word; words >> word;)
    if (word.size() < 4 || word.find_first_not_of('-') != std::string::npos)
      kept.push_back(word);
  return joined(kept, " ");
}

/// The value of a key, for a message.
inline std::string shown(const std::string& value)
{
  return value.empty() ? "not given" : value;
}

/// The text as a string of JSON, in its quotation marks. @pre it is in one line
inline std::string in_json(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

/// Number of insertions, deletions and substitutions between two words, capitals ignored.
/// Source: Wagner & Fischer (1974), J. ACM 21, 168.
inline std::size_t edit_distance(const std::string& a, const std::string& b)
{
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1); // distances of a's first i letters
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (lower(a[i]) != lower(b[j]) ? 1 : 0);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// The nearest of `words`, the first of equals; "" if none is like `word` (more than a
/// third of its letters, and more than two, differ).
inline std::string nearest(const std::string& word, const std::vector<std::string>& words)
{
  std::string best;
  std::size_t smallest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : words) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < smallest && distance < std::max(word.size(), candidate.size())) {
      smallest = distance;
      best = candidate;
    }
  }
  return best;
}

} // namespace mergel::apps
