#include "dem/text.h"

#include "dem/error.h"

#include <array>
#include <charconv>

namespace mergel::dem {

std::string shortest(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string rounded(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, 6)
                       .ptr;
  return {text.data(), end};
}

std::string plain_text(std::string content)
{
  if (content.starts_with("\xFF\xFE") || content.starts_with("\xFE\xFF"))
    throw InputError("is UTF-16, not UTF-8: save it as \"CSV UTF-8\" or as plain text");
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  std::size_t end = 0;
  for (std::size_t at = 0; at < content.size(); ++at) {
    const bool is_return = content[at] == '\r';
    content[end++] = is_return ? '\n' : content[at];
    if (is_return && at + 1 < content.size() && content[at + 1] == '\n') ++at;
  }
  content.resize(end);
  return content;
}

} // namespace mergel::dem
