#include "dem/io/hdf5/hdf5.h"

namespace mergel::dem::hdf5 {

Handle user_block(std::size_t bytes)
{
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  if (creation >= 0 && H5Pset_userblock(creation, bytes) < 0) {
    H5Pclose(creation);
    throw NumericalError("HDF5 cannot leave room at the start of a file");
  }
  return Handle(creation, H5Pclose, "describe a file");
}

Handle create_array(hid_t file, const std::string& name, hid_t type, const Shape& shape,
                    hid_t creation)
{
  const hsize_t size[2] = {shape.rows, shape.columns};
  const Handle space(H5Screate_simple(shape.columns == 1 ? 1 : 2, size, nullptr), H5Sclose,
                     "describe an array");
  return Handle(
      H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Dclose, "create " + name);
}

void write_array(hid_t file, const std::string& name, hid_t type, const void* data,
                 const Shape& shape)
{
  const Handle plain(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe an array");
  H5Pset_obj_track_times(plain, false); // equal data give equal files
  Handle array = create_array(file, name, type, shape, plain);
  if (shape.rows > 0 && H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    throw NumericalError("HDF5 cannot write " + name);
  array.finish("write " + name);
}

Shape shape_of(hid_t array, const std::string& name, std::size_t size_of_number)
{
  const Handle space(H5Dget_space(array), H5Sclose, "read " + name);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, size, nullptr) < 0)
    throw NumericalError("wrong shape of " + name);
  const hsize_t stored = H5Dget_storage_size(array);
  if (size[1] == 0 || size[0] > stored / size_of_number / size[1])
    throw NumericalError("missing data of " + name);
  return {size[0], size[1]};
}

void read_into(hid_t array, const std::string& name, hid_t type, void* data)
{
  if (H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    throw NumericalError("HDF5 cannot read " + name);
}

void write_attribute(hid_t file, const std::string& name, hid_t type, const void* value)
{
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Handle a(H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                 H5Aclose, "create " + name);
  if (H5Awrite(a, type, value) < 0) throw NumericalError("HDF5 cannot write " + name);
}

void read_attribute(hid_t file, const std::string& name, hid_t type, void* value)
{
  const Handle a(H5Aopen(file, name.c_str(), H5P_DEFAULT), H5Aclose, "find " + name);
  require_single(a, name, type);
  if (H5Aread(a, type, value) < 0) throw NumericalError("HDF5 cannot read " + name);
}

void write_text_attribute(hid_t file, const std::string& name, const std::string& text)
{
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  H5Tset_size(type, text.size() + 1);
  write_attribute(file, name, type, text.c_str());
}

} // namespace mergel::dem::hdf5
