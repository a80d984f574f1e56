/// A list of words in one line of text: separated by blanks; a word with a blank in it stands
/// in double quotes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mergel::apps {

/// The words, without their quotes.
/// @throws InputError when a quote is not closed, or stands inside a word
std::vector<std::string> words_of(std::string_view list);

/// The word as words_of() reads it: in quotes where it has a blank or is empty.
/// @throws InputError when it has a quote itself, which no list can hold
std::string as_word(const std::string& word);

} // namespace mergel::apps
