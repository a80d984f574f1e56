/// Checks before HDF5 reads a file: it may hold plain arrays and single numbers only,
/// stored in that file itself. A valid checksum does not make a file safe: any program can
/// write one, and HDF5 reads as much as the file specifies, from any place that it names.
#pragma once

#include <hdf5.h>

#include <string>

namespace mergel::dem {

/// All throw NumericalError, naming the object that fails.

/// `name` is stored in the file itself: it is no link.
void require_own(hid_t file, const std::string& name);

/// The array is stored in the file contiguously and uncompressed.
void require_in_one_piece(hid_t array, const std::string& name);
/// The same, and its numbers have the class and size of `type`.
void require_plain_array(hid_t array, const std::string& name, hid_t type);

/// The attribute is one value, not an array of them.
void require_single(hid_t attribute, const std::string& name);
/// The same, and it has the class and size of `type`.
void require_single(hid_t attribute, const std::string& name, hid_t type);

} // namespace mergel::dem
