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

/// Number of bytes of the character of UTF-8 at `text[at]`; 0 where there is none, or one that
/// moves the cursor of a terminal (U+0000 to U+001F, U+007F to U+009F).
inline std::size_t length_of_printable(std::string_view text, std::size_t at)
{
  const auto byte = [&](std::size_t k) {
    return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t n = first >= 0xf0 && first < 0xf5 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first >= 0xf5) return 0;
  for (std::size_t k = 1; k < n; ++k)
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  return first == 0xc2 && byte(1) < 0xa0 ? 0 : n;
}

/// The byte as \xNN.
inline std::string escaped_byte(char c)
{
  const char* const digits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', digits[byte / 16], digits[byte % 16]};
}

/// The text for a terminal: control characters, which would act on it, and bytes that are no
/// UTF-8 become \xNN. Newlines and tabulators stay.
inline std::string printable(std::string_view text)
{
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = length_of_printable(text, at);
    if (n > 0 || text[at] == '\n' || text[at] == '\t')
      result += text.substr(at, std::max<std::size_t>(n, 1));
    else
      result += escaped_byte(text[at]);
    at += std::max<std::size_t>(n, 1);
  }
  return result;
}

/// The word as a shell reads it: quoted where it has a blank or another special character.
inline std::string in_shell(const std::string& word)
{
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                            "_-+=./,:@%^";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  bool is_printable = true;
  for (std::size_t at = 0; is_printable && at < word.size();) {
    const std::size_t n = length_of_printable(word, at);
    is_printable = n > 0;
    at += n;
  }
  std::string quoted = is_printable ? "'" : "$'";
  for (std::size_t at = 0; at < word.size();) {
    const std::size_t n = length_of_printable(word, at);
    if (word[at] == '\'')
      quoted += is_printable ? "'\\''" : "\\'";
    else if (n == 0)
      quoted += escaped_byte(word[at]);
    else
      quoted += (!is_printable && word[at] == '\\' ? "\\" : "") + word.substr(at, n);
    at += std::max<std::size_t>(n, 1);
  }
  return quoted + "'";
}

/// The text as a string of JSON, in its quotation marks. What is no UTF-8 becomes \xNN.
inline std::string in_json(const std::string& text)
{
  std::string quoted = "\"";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = length_of_printable(text, at);
    const auto byte = static_cast<unsigned char>(text[at]);
    if (n == 1 && (byte == '"' || byte == '\\'))
      quoted += std::string("\\") + text[at];
    else if (n == 0 && byte < 0x80)
      quoted += "\\u00" + escaped_byte(text[at]).substr(2);
    else
      quoted += n > 0 ? text.substr(at, n) : "\\" + escaped_byte(text[at]);
    at += std::max<std::size_t>(n, 1);
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
