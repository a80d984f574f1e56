#include "dem/io/hdf5/plain_hdf5.h"

#include "dem/error.h"

namespace mergel::dem {

namespace {

/// Same class and size. False also when a type is not valid.
bool is_alike(hid_t found, hid_t wanted)
{
  return found >= 0 && H5Tget_class(found) == H5Tget_class(wanted) &&
         H5Tget_size(found) == H5Tget_size(wanted);
}

} // namespace

void require_own(hid_t file, const std::string& name)
{
  H5L_info_t link;
  if (H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) < 0)
    throw NumericalError("HDF5 cannot find " + name);
  if (link.type != H5L_TYPE_HARD) throw NumericalError(name + " is a link");
}

void require_in_one_piece(hid_t array, const std::string& name)
{
  const hid_t list = H5Dget_create_plist(array);
  const bool is_in_one_piece = list >= 0 && H5Pget_layout(list) == H5D_CONTIGUOUS &&
                               H5Pget_external_count(list) == 0;
  if (list >= 0) H5Pclose(list);
  if (!is_in_one_piece) throw NumericalError(name + " is not stored contiguously");
}

void require_plain_array(hid_t array, const std::string& name, hid_t type)
{
  require_in_one_piece(array, name);
  const hid_t found = H5Dget_type(array);
  const bool is_as_wanted = is_alike(found, type);
  if (found >= 0) H5Tclose(found);
  if (!is_as_wanted) throw NumericalError("wrong type of " + name);
}

void require_single(hid_t attribute, const std::string& name)
{
  const hid_t space = H5Aget_space(attribute);
  const bool is_single = space >= 0 && H5Sget_simple_extent_type(space) == H5S_SCALAR;
  if (space >= 0) H5Sclose(space);
  if (!is_single) throw NumericalError(name + " is not a single value");
}

void require_single(hid_t attribute, const std::string& name, hid_t type)
{
  require_single(attribute, name);
  const hid_t found = H5Aget_type(attribute);
  const bool is_as_wanted = is_alike(found, type);
  if (found >= 0) H5Tclose(found);
  if (!is_as_wanted) throw NumericalError("wrong type of " + name);
}

} // namespace mergel::dem
