/// Why a file cannot be read, in the system's words: a file that is forbidden is not absent,
/// and not damaged.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace mergel::dem {

/// What the system says when the file is opened for reading; no error for a regular file
/// that can be read. A folder is errc::is_a_directory; what is neither is errc::invalid_seek,
/// as a pipe is.
std::error_code reading_error(const std::filesystem::path& file);

/// The same of a folder: that its files can be listed and reached.
std::error_code listing_error(const std::filesystem::path& folder);

/// The error with its remedy: "Permission denied. Check its permissions and those of its
/// folders". @pre error
std::string with_remedy(const std::error_code& error);

/// False for a file that does not exist.
/// @throws InputError "FILE: cannot be read: ..." when it does and cannot be read, or the
///   system cannot say whether it does
bool is_readable(const std::filesystem::path& file);

/// @throws InputError "FILE: cannot be read: ..." when it cannot
void require_readable(const std::filesystem::path& file);

/// @throws InputError "FOLDER: is no folder" or "FOLDER: cannot be read: ..."
void require_folder(const std::filesystem::path& folder);

/// Whether the file begins with these bytes; false where it cannot be read.
bool begins_with(const std::filesystem::path& file, std::string_view bytes);

} // namespace mergel::dem
