/// Atomic replacement of files: a file is completely the old one or completely the new one.
/// It is written in its folder under a temporary name, flushed to the disk, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace mergel::dem {

/// The name under which `file` is written first: same folder, same extension (some writers
/// require it), not matched by "*": fields/.walls_0000.partial.vtp for
/// fields/walls_0000.vtp.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Call `write(temporary_name(file))`, flush what it wrote to the disk, and rename it to
/// `file`.
///
/// The folder must exist; only one process at a time may write a given file. If anything
/// fails, the temporary file is removed, an earlier `file` is unchanged, and the exception
/// is passed on.
/// @throws NumericalError naming the file and the system's reason (full disk, missing
///   folder, no permission), or that `write` left no file; any exception of `write`
void replace_file(const std::filesystem::path& file,
                  const std::function<void(const std::filesystem::path&)>& write);

/// Replace the contents of `file` by these bytes; as above.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

} // namespace mergel::dem
