/// A mark and a sum of all bytes behind the data of a file, so that a changed, cut or
/// foreign file is told before HDF5 sees it: HDF5 does not survive every damaged file, and
/// does not look beyond its own data.
#pragma once

#include "dem/error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace mergel::dem {

/// Fowler, Noll, Vo (1991): one product a byte.
std::uint64_t fnv_1a(std::string_view bytes, std::uint64_t start = 0xcbf29ce484222325u);

/// The same by words of eight bytes, the last filled up with zeros and the length added;
/// the upper half of each sum is folded into the lower, or two flipped signs would cancel.
std::uint64_t sum_of_words(std::string_view bytes);

/// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t number);

/// The bytes of a file are not those that were sealed: it was cut, changed, or is another's.
/// What cannot be read for another reason (permissions, a newer format) may be whole.
struct DamagedFile : InputError {
  using InputError::InputError;
};

struct Seal {
  std::string kind;   ///< "sample"
  std::string sum;    ///< name of the sum, as the mark tells it
  std::string remedy; ///< "make it again with `mergel sample`"
  std::uint64_t (*of)(std::string_view bytes);
};

std::string sealed(std::string bytes, const Seal& seal);

/// All that a file holds, without a look at it. @throws InputError, without its name
std::string bytes_of(const std::filesystem::path& file);

/// Append the seal to a file that holds these bytes. @throws NumericalError
void seal(const std::filesystem::path& file, std::string_view bytes, const Seal& seal);

/// The data of a sealed file, the seal taken off.
/// @param sum if not null, becomes their sum
/// @throws DamagedFile, without the file's name, when it was not sealed so, or was changed
///   since; InputError when it cannot be read
std::string unsealed(const std::filesystem::path& file, const Seal& seal,
                     std::uint64_t* sum = nullptr);

} // namespace mergel::dem
