/// An HDF5 file that is read from memory: HDF5 reads the bytes of which the checksum was
/// computed.
#pragma once

#include "dem/io/hdf5/hdf5.h"

#include <filesystem>
#include <string>

namespace mergel::dem::hdf5 {

/// The bytes are not copied; they must outlive the object.
class OpenBytes {
public:
  /// @param path of the file from which the bytes were read
  /// @throws NumericalError when the bytes are no HDF5 file
  OpenBytes(std::string& bytes, const std::filesystem::path& path);
  hid_t file() const { return file_; }

private:
  Handle access_, file_;
};

} // namespace mergel::dem::hdf5
