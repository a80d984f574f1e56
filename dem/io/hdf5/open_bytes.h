/// An HDF5 file that is read from memory: what HDF5 reads is what was summed.
#pragma once

#include "dem/io/hdf5/hdf5.h"

#include <filesystem>
#include <string>

namespace mergel::dem::hdf5 {

/// The bytes stay where they are; they must outlive it.
class OpenBytes {
public:
  /// @param path of the file that they are from
  /// @throws NumericalError when they are no HDF5 file
  OpenBytes(std::string& bytes, const std::filesystem::path& path);
  hid_t file() const { return file_; }

private:
  Handle access_, file_;
};

} // namespace mergel::dem::hdf5
