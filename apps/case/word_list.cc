#include "apps/case/word_list.h"

#include "dem/error.h"

#include <algorithm>

namespace mergel::apps {

namespace {

constexpr std::string_view blanks = " \t";

} // namespace

std::vector<std::string> words_of(std::string_view list)
{
  std::vector<std::string> words;
  for (;;) {
    list.remove_prefix(std::min(list.find_first_not_of(blanks), list.size()));
    if (list.empty()) return words;
    const bool is_quoted = list.front() == '"';
    if (is_quoted) list.remove_prefix(1);
    const auto end = list.find_first_of(is_quoted ? "\"" : blanks);
    if (is_quoted && end == std::string_view::npos)
      throw InputError(
          "has a quotation mark that is never closed. Write a name with blanks "
          "as \"the name\"");
    const std::string_view word = list.substr(0, end);
    list.remove_prefix(std::min(word.size() + (is_quoted ? 1 : 0), list.size()));
    const bool is_apart = list.empty() || blanks.find(list.front()) != blanks.npos;
    if (word.find('"') != word.npos || !is_apart)
      throw InputError(
          "has a quotation mark inside a name. Put the whole name in quotation "
          "marks, with a blank before and behind");
    words.emplace_back(word);
  }
}

std::string as_word(const std::string& word)
{
  if (word.find('"') != std::string::npos)
    throw InputError("the name " + word +
                     " has a quotation mark, which a list of names cannot hold. Rename it");
  const bool is_plain = !word.empty() && word.find_first_of(blanks) == std::string::npos;
  return is_plain ? word : '"' + word + '"';
}

} // namespace mergel::apps
