#include "tests/fuzz/crafted_hdf5.h"

#include "tests/fuzz/reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace mergel::fuzz {

namespace {

/// Takes the choices from the bytes, one after the other.
class Choices {
public:
  explicit Choices(const std::string& bytes) : bytes_(bytes) {}
  std::size_t of(std::size_t n) { return next() % n; }

private:
  unsigned char next()
  {
    return at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : 0;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// A new type, to be closed by the caller; 0 gives the usual one.
hid_t type_of(std::size_t choice, hid_t usual)
{
  switch (choice) {
  case 1:
    return H5Tcopy(H5T_IEEE_F32LE);
  case 2:
    return H5Tcopy(H5T_IEEE_F64BE);
  case 3:
    return H5Tcopy(H5T_NATIVE_INT64);
  case 4:
    return H5Tcopy(H5T_NATIVE_UCHAR);
  case 5:
    return H5Tcopy(H5T_NATIVE_UINT32);
  case 6: {
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 1000);
    return text;
  }
  case 7: {
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, H5T_VARIABLE);
    return text;
  }
  case 8:
    return H5Tvlen_create(H5T_NATIVE_DOUBLE);
  case 9: {
    const hid_t pair = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(pair, "a", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(pair, "b", 8, H5T_NATIVE_DOUBLE);
    return pair;
  }
  case 10: {
    const hsize_t size[1] = {1000};
    return H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, size);
  }
  case 11:
    return H5Tcopy(H5T_STD_REF_OBJ);
  case 12: {
    const hid_t opaque = H5Tcreate(H5T_OPAQUE, 8);
    H5Tset_tag(opaque, "opaque");
    return opaque;
  }
  default:
    return H5Tcopy(usual);
  }
}
constexpr std::size_t n_types = 13;

bool is_number(hid_t type)
{
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_FLOAT || kind == H5T_INTEGER;
}

hsize_t length(std::size_t choice, hsize_t usual)
{
  constexpr hsize_t huge = hsize_t{1} << 61;
  const std::array<hsize_t, 8> lengths{usual, 0,        1,   usual + 1,
                                       huge,  huge / 3, 100, 0xffffffffu};
  return lengths[choice];
}
constexpr std::size_t n_lengths = 8;

std::vector<hsize_t> shape(Choices& choose, const CraftedArray& array)
{
  std::vector<hsize_t> size = array.size;
  switch (choose.of(6)) {
  case 1:
    size.clear();
    break; // one value, without dimension
  case 2:
    size.push_back(1);
    break;
  case 3:
    size.assign(20, 1);
    break;
  case 4:
    size.pop_back();
    break;
  default:
    break;
  }
  for (hsize_t& n : size) n = length(choose.of(n_lengths), n);
  return size;
}

hid_t layout(std::size_t choice, const std::vector<hsize_t>& size)
{
  const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
  switch (choice) {
  case 1:
    H5Pset_layout(plist, H5D_COMPACT);
    break;
  case 2:
  case 3: {
    const std::vector<hsize_t> chunk(std::max<std::size_t>(1, size.size()), 2);
    H5Pset_chunk(plist, static_cast<int>(chunk.size()), chunk.data());
    if (choice == 3) H5Pset_deflate(plist, 9);
    break;
  }
  case 4:
    H5Pset_external(plist, "/dev/zero", 0, H5F_UNLIMITED);
    break;
  case 5: {
    const double fill = std::numeric_limits<double>::quiet_NaN();
    H5Pset_fill_value(plist, H5T_NATIVE_DOUBLE, &fill);
    break;
  }
  default:
    break;
  }
  return plist;
}

/// Values that a good sample does not have.
double odd(std::size_t choice)
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::array<double, 8> values{
      0.0,   -1.0, inf,          std::numeric_limits<double>::quiet_NaN(),
      1e308, 2.0,  4294967295.0, 1e-310};
  return values[choice];
}

void add_array(hid_t file, Choices& choose, const CraftedArray& array)
{
  const std::size_t link = choose.of(8);
  const std::string target = "target of " + array.name;
  std::string name = array.name;
  if (link == 1) return; // missing
  if (link == 2)
    H5Lcreate_soft("/nowhere", file, array.name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  if (link == 3)
    H5Lcreate_soft(array.name.c_str(), file, array.name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  if (link == 4)
    H5Lcreate_external("/dev/zero", "/x", file, array.name.c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
  if (link == 5) {
    H5Lcreate_soft(target.c_str(), file, array.name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    name = target;
  }
  if (link == 6) {
    H5Gclose(H5Gcreate2(file, array.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    return;
  }

  const std::vector<hsize_t> size = shape(choose, array);
  const hid_t type = type_of(choose.of(n_types), array.type);
  const hid_t plist = layout(choose.of(6), size);
  const hid_t space =
      size.empty() ? H5Screate(H5S_SCALAR)
                   : H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  const hid_t set =
      H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, plist, H5P_DEFAULT);
  std::vector<double> values = array.values;
  if (choose.of(4) == 1 && !values.empty()) {
    const std::size_t which = choose.of(values.size());
    values[which] = odd(choose.of(8));
  }
  double n_values = 1.0; // as a double: the product of the lengths may not fit an integer
  for (const hsize_t n : size) n_values *= static_cast<double>(n);
  if (set >= 0 && is_number(type) && n_values <= static_cast<double>(values.size()))
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  if (set >= 0) H5Dclose(set);
  if (space >= 0) H5Sclose(space);
  if (type >= 0) H5Tclose(type);
  H5Pclose(plist);
}

/// Fills an attribute of `n` values, if its type can hold the good value.
void write(hid_t a, hid_t type, const CraftedAttribute& attribute, double number,
           std::size_t n)
{
  if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0) {
    std::string one = attribute.text;
    one.resize(H5Tget_size(type));
    std::string all;
    for (std::size_t k = 0; k < n; ++k) all += one;
    H5Awrite(a, type, all.data());
  } else if (is_number(type))
    H5Awrite(a, H5T_NATIVE_DOUBLE, std::vector<double>(n, number).data());
}

hid_t usual_type(const CraftedAttribute& attribute)
{
  if (attribute.text.empty()) return H5Tcopy(attribute.type);
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, attribute.text.size() + 1);
  return text;
}

void add_attribute(hid_t file, Choices& choose, const CraftedAttribute& attribute)
{
  const std::size_t kind = choose.of(4);
  if (kind == 1) return; // missing
  std::vector<hsize_t> size;
  if (kind == 2) size = {length(choose.of(n_lengths), 4) % 2000};
  if (kind == 3) size = {1000};
  const hid_t usual = usual_type(attribute);
  const hid_t type = type_of(choose.of(n_types), usual);
  const hid_t space =
      size.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, size.data(), nullptr);
  const hid_t a =
      H5Acreate2(file, attribute.name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
  double number = attribute.number;
  if (choose.of(4) == 1) number = odd(choose.of(8));
  if (a >= 0) write(a, type, attribute, number, size.empty() ? 1 : size.front());
  if (a >= 0) H5Aclose(a);
  if (space >= 0) H5Sclose(space);
  if (type >= 0) H5Tclose(type);
  H5Tclose(usual);
}

} // namespace

void craft_hdf5(const std::filesystem::path& path, const std::vector<CraftedArray>& arrays,
                const std::vector<CraftedAttribute>& attributes, const std::string& bytes)
{
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, dem::seal_room);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  Choices choose(bytes);
  for (const CraftedArray& array : arrays) add_array(file, choose, array);
  for (const CraftedAttribute& attribute : attributes)
    add_attribute(file, choose, attribute);
  H5Fclose(file);
  H5Pclose(creation);
}

void seal_crafted(const std::filesystem::path& file, const dem::Seal& seal)
{
  std::string bytes = dem::bytes_of(file);
  bytes.resize(std::max(bytes.size(), dem::seal_room));
  write_bytes(file, dem::sealed(std::move(bytes), seal));
}

} // namespace mergel::fuzz
