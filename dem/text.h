/// Numbers as text, and text as others write it.
#pragma once

#include <string>

namespace mergel::dem {

/// The shortest decimal text that reads back to the same bits.
std::string shortest(double value);

/// At most six digits, for messages: a computed length has a tail of no use.
std::string rounded(double value);

/// The content of a text file with one kind of line break: without the byte order mark that some
/// programs put before UTF-8, and with LF where it has CR LF or CR.
/// @throws InputError for UTF-16, which begins with a mark of its own
std::string plain_text(std::string content);

} // namespace mergel::dem
