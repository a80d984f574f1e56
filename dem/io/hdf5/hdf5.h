/// Wrappers of HDF5: handles, arrays, attributes.
#pragma once

#include "dem/error.h"
#include "dem/io/hdf5/plain_hdf5.h"

#include <hdf5.h>

#include <string>
#include <vector>

namespace mergel::dem::hdf5 {

/// A handle, closed by the destructor.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close)
  {
    if (id_ < 0) throw NumericalError("HDF5 cannot " + what);
  }
  ~Handle()
  {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

  /// Close now and report a failure, such as a full disk.
  void finish(const std::string& what)
  {
    const herr_t status = close_(id_);
    id_ = -1;
    if (status < 0) throw NumericalError("HDF5 cannot " + what);
  }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Switches off the messages of HDF5: its stack of errors, and at exit a message for each
/// damaged file that it could not close. Handles here close themselves.
class Quiet {
public:
  Quiet()
  {
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Rows and columns of an array; one column is an array of one dimension.
struct Shape {
  hsize_t rows = 0, columns = 1;
};

/// All functions below throw NumericalError, naming what HDF5 cannot do.

/// The settings of a new file whose first bytes HDF5 leaves to the program.
/// @param bytes 512 or a larger power of two
Handle user_block(std::size_t bytes);

/// Create an array of this shape.
Handle create_array(hid_t file, const std::string& name, hid_t type, const Shape& shape,
                    hid_t creation = H5P_DEFAULT);

void write_array(hid_t file, const std::string& name, hid_t type, const void* data,
                 const Shape& shape);

/// Shape of an array, after a check that all of its data are in the file: a changed size
/// must not cause an allocation larger than the stored data.
Shape shape_of(hid_t array, const std::string& name, std::size_t size_of_number);

void read_into(hid_t array, const std::string& name, hid_t type, void* data);

template <class T>
std::vector<T> read_array(hid_t file, const std::string& name, hid_t type, hsize_t columns)
{
  require_own(file, name);
  const Handle array(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "find " + name);
  require_plain_array(array, name, type);
  const Shape shape = shape_of(array, name, sizeof(T));
  if (shape.columns != columns) throw NumericalError("wrong shape of " + name);
  std::vector<T> data(shape.rows * columns);
  if (!data.empty()) read_into(array, name, type, data.data());
  return data;
}

void write_attribute(hid_t file, const std::string& name, hid_t type, const void* value);
void read_attribute(hid_t file, const std::string& name, hid_t type, void* value);
void write_text_attribute(hid_t file, const std::string& name, const std::string& text);

} // namespace mergel::dem::hdf5
