/// Seal of a file: a mark and a checksum of all bytes, appended to the data. A changed,
/// truncated or unrelated file is detected before HDF5 reads it: HDF5 crashes on some
/// damaged files. It ignores bytes after its own data.
#pragma once

#include "dem/error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace mergel::dem {

/// Checksum of Fowler, Noll and Vo (1991): one product per byte.
std::uint64_t fnv_1a(std::string_view bytes, std::uint64_t start = 0xcbf29ce484222325u);

/// The same by words of eight bytes, the last one padded with zeros, and the length. The
/// upper half of each sum is folded into the lower; otherwise two flipped signs would
/// cancel.
std::uint64_t sum_of_words(std::string_view bytes);

/// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t number);

/// The bytes of a file are not those that were sealed: it was truncated or changed, or it
/// is another kind of file. A file that cannot be read for another reason (permissions, a
/// newer format) may be undamaged.
struct DamagedFile : InputError {
  using InputError::InputError;
};

struct Seal {
  std::string kind;                            ///< "sample"
  std::string sum;                             ///< name of the checksum in the mark
  std::string remedy;                          ///< "make it again with `mergel sample`"
  std::uint64_t (*of)(std::string_view bytes); ///< computes the checksum
};

/// The bytes with the seal appended.
std::string sealed(std::string bytes, const Seal& seal);

/// All bytes of a file, unchecked. @throws InputError, without the file's name
std::string bytes_of(const std::filesystem::path& file);

/// Append the seal to a file that holds these bytes. @throws NumericalError
void seal(const std::filesystem::path& file, std::string_view bytes, const Seal& seal);

/// The data of a sealed file, without the seal.
/// @param sum if not null, becomes their checksum
/// @throws DamagedFile, without the file's name, when it does not have this seal or was
///   changed since; InputError when it cannot be read
std::string unsealed(const std::filesystem::path& file, const Seal& seal,
                     std::uint64_t* sum = nullptr);

} // namespace mergel::dem
