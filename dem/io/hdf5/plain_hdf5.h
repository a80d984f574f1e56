/// What a file of ours may hold in HDF5, looked at before it is read: plain arrays and single
/// numbers, in that very file. A right sum over the bytes does not make a file harmless: any
/// program can write one, and HDF5 reads as much as the file says, from wherever it says.
#pragma once

#include <hdf5.h>

#include <string>

namespace mergel::dem {

/// All throw NumericalError, naming what is not plain.

/// `name` is in the file itself: no link to another place or file.
void require_own(hid_t file, const std::string& name);

/// The array lies in the file in one piece, uncompressed.
void require_in_one_piece(hid_t array, const std::string& name);
/// The same, in numbers of this class and size.
void require_plain_array(hid_t array, const std::string& name, hid_t type);

/// The attribute is one value, not an array of them.
void require_single(hid_t attribute, const std::string& name);
/// The same, and a number of this class and size.
void require_single(hid_t attribute, const std::string& name, hid_t type);

} // namespace mergel::dem
