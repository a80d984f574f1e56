/// Seal of an HDF5 file: a mark, the checksum and the length of its data. A changed,
/// truncated or unrelated file is detected before HDF5 reads it: HDF5 crashes on some
/// damaged files. The seal is in the user block, the first bytes of the file, which HDF5
/// leaves alone. A program that opens the file for writing and closes it unchanged keeps it:
///
///     mergel sample, FNV-1a 0123456789abcdef, 6168 bytes behind these 512
///
/// padded with zeros to seal_room bytes. Files of earlier versions have mark and checksum
/// at their end, where such a program cuts them off; they are still read.
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

/// Length of the seal: the smallest user block of HDF5 (H5Pset_userblock).
constexpr std::size_t seal_room = 512;

struct Seal {
  std::string kind;                            ///< "sample"
  std::string sum;                             ///< name of the checksum in the mark
  std::string remedy;                          ///< "make it again with `mergel sample`"
  std::uint64_t (*of)(std::string_view bytes); ///< computes the checksum
};

/// The bytes of a file with the seal in its first seal_room bytes.
/// @pre bytes.size() >= seal_room
std::string sealed(std::string bytes, const Seal& seal);

/// All bytes of a file, unchecked. @throws InputError, without the file's name
std::string bytes_of(const std::filesystem::path& file);

/// The seal of a file that holds these bytes: seal_room bytes for its start.
/// @pre bytes.size() >= seal_room
std::string seal_block(std::string_view bytes, const Seal& seal);

/// Whether the file begins as a sealed file of this kind does, also one of an earlier
/// version. It may be damaged; a file that cannot be read does not.
bool begins_as_sealed(const std::filesystem::path& file, std::string_view kind);

/// The bytes of a sealed file, for HDF5 to read: with the user block, without a seal at the
/// end.
/// @param sum if not null, becomes the checksum of the data
/// @throws DamagedFile, without the file's name, when it does not have this seal or was
///   changed since; InputError when it cannot be read
std::string unsealed(const std::filesystem::path& file, const Seal& seal,
                     std::uint64_t* sum = nullptr);

} // namespace mergel::dem
