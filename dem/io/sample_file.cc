#include "dem/io/sample_file.h"

#include "dem/io/atomic_file.h"

#include <hdf5.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace mergel::dem {

namespace {

constexpr int version = 2;
const char* const format = "mergel sample";

/// An HDF5 handle with its own way to close.
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

  /// Close now and notice a failure, such as a full disk.
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

/// HDF5 prints its own stack of errors unless told not to, and at exit a complaint about each
/// damaged file that it could not close. Every handle here closes itself.
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

/// What follows the HDF5 data: a mark and the sum of all bytes before it. HDF5 ignores it; a
/// file without it, or with another sum, is never shown to HDF5, which does not survive every
/// damaged file.
const std::string mark = "mergel sample, FNV-1a ";
constexpr std::size_t digits = 16;

std::string fnv_1a(const std::string& bytes, std::size_t n)
{
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (std::size_t k = 0; k < n; ++k)
    sum = (sum ^ static_cast<unsigned char>(bytes[k])) * 0x100000001b3u;
  std::string hex(digits, '0');
  for (std::size_t k = digits; k-- > 0; sum >>= 4) hex[k] = "0123456789abcdef"[sum & 15u];
  return hex;
}

std::string all_bytes(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  if (!in) throw NumericalError(file.string() + ": cannot be read");
  return bytes;
}

void seal(const std::filesystem::path& file)
{
  const std::string bytes = all_bytes(file);
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << mark << fnv_1a(bytes, bytes.size());
  out.flush();
  if (!out) throw NumericalError(file.string() + ": cannot be written; is the disk full?");
}

/// @throws InputError when the file was not sealed, or was changed since
void check_seal(const std::filesystem::path& file)
{
  const std::string bytes = all_bytes(file);
  const std::string hdf5 = "\x89HDF\r\n\x1a\n";
  if (bytes.compare(0, hdf5.size(), hdf5) != 0)
    throw InputError("is no sample: it is not an HDF5 file; make one with `mergel sample`");
  const std::size_t tail = mark.size() + digits;
  if (bytes.size() < tail || bytes.compare(bytes.size() - tail, mark.size(), mark) != 0)
    throw InputError("is no sample, or is truncated; make one with `mergel sample`");
  if (bytes.compare(bytes.size() - digits, digits, fnv_1a(bytes, bytes.size() - tail)) != 0)
    throw InputError(
        "is damaged (its checksum does not match); make it again with `mergel sample`");
}

/// The arrays of a sample as they lie in the file.
struct Columns {
  std::vector<double> x, R, m, S;
  std::vector<std::uint32_t> bonds;
  std::vector<std::int16_t> shifts;
  std::vector<double> cell;
  std::string keys, values; ///< one line each
  double bond_limit = 0.0, porosity = 0.0, whole_porosity = 0.0, overlap = 0.0,
         pressure = 0.0, friction = 0.0;
};

void write_array(hid_t file, const char* name, hid_t type, const void* data, hsize_t rows,
                 hsize_t columns)
{
  const hsize_t size[2] = {rows, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose,
                     "describe an array");
  const Handle plain(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe an array");
  H5Pset_obj_track_times(plain, false); // the same sample is the same file
  Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, plain, H5P_DEFAULT), H5Dclose,
             std::string("create ") + name);
  if (rows > 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    throw NumericalError(std::string("HDF5 cannot write ") + name);
  set.finish(std::string("write ") + name);
}

template <class T>
std::vector<T> read_array(hid_t file, const char* name, hid_t type, hsize_t columns)
{
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose,
                   std::string("find ") + name);
  const Handle space(H5Dget_space(set), H5Sclose, std::string("read ") + name);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != (columns == 1 ? 1 : 2) ||
      H5Sget_simple_extent_dims(space, size, nullptr) < 0 || size[1] != columns)
    throw NumericalError(std::string("the shape is wrong of ") + name);
  // A changed size must not ask for more memory than the file can fill.
  if (H5Dget_storage_size(set) < size[0] * columns * sizeof(T))
    throw NumericalError(std::string("data are missing of ") + name);
  std::vector<T> data(size[0] * columns);
  if (!data.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
    throw NumericalError(std::string("HDF5 cannot read ") + name);
  return data;
}

void write_attribute(hid_t file, const char* name, hid_t type, const void* value)
{
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Handle a(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                 std::string("create ") + name);
  if (H5Awrite(a, type, value) < 0)
    throw NumericalError(std::string("HDF5 cannot write ") + name);
}

void read_attribute(hid_t file, const char* name, hid_t type, void* value)
{
  const Handle a(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, std::string("find ") + name);
  if (H5Aread(a, type, value) < 0)
    throw NumericalError(std::string("HDF5 cannot read ") + name);
}

std::vector<std::string> lines(const std::string& text)
{
  std::vector<std::string> out;
  std::size_t start = 0;
  for (std::size_t end; (end = text.find('\n', start)) != std::string::npos;
       start = end + 1)
    out.push_back(text.substr(start, end - start));
  return out;
}

Columns to_columns(const Sample& s)
{
  Columns c;
  for (const Body& b : s.packing.particles.body) {
    c.x.insert(c.x.end(), {b.x.x(), b.x.y(), b.x.z()});
    c.R.push_back(b.R);
    c.m.push_back(b.m);
    c.S.push_back(b.S);
  }
  for (const Pair& q : s.bonding.pairs) {
    c.bonds.insert(c.bonds.end(), {q.i, q.j});
    c.shifts.insert(c.shifts.end(), q.shift.begin(), q.shift.end());
  }
  c.cell = {s.packing.cell.size.x(), s.packing.cell.size.y(), s.packing.cell.size.z()};
  for (const auto& [key, value] : s.recipe) {
    c.keys += key + '\n';
    c.values += value + '\n';
  }
  c.bond_limit = s.bonding.limit;
  c.porosity = s.packing.porosity;
  c.whole_porosity = s.packing.whole_porosity;
  c.overlap = s.packing.overlap;
  c.pressure = s.packing.pressure;
  c.friction = s.packing.friction;
  return c;
}

void write_columns(const std::filesystem::path& path, const Columns& c)
{
  const Quiet quiet;
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
              "create " + path.string());
  const auto rows = [](std::size_t n) { return static_cast<hsize_t>(n); };
  write_array(file, "x", H5T_NATIVE_DOUBLE, c.x.data(), rows(c.R.size()), 3);
  write_array(file, "R", H5T_NATIVE_DOUBLE, c.R.data(), rows(c.R.size()), 1);
  write_array(file, "m", H5T_NATIVE_DOUBLE, c.m.data(), rows(c.R.size()), 1);
  write_array(file, "S", H5T_NATIVE_DOUBLE, c.S.data(), rows(c.R.size()), 1);
  write_array(file, "bonds", H5T_NATIVE_UINT32, c.bonds.data(), rows(c.bonds.size() / 2),
              2);
  write_array(file, "bond_shifts", H5T_NATIVE_INT16, c.shifts.data(),
              rows(c.shifts.size() / 3), 3);
  write_array(file, "cell", H5T_NATIVE_DOUBLE, c.cell.data(), 3, 1);
  write_array(file, "recipe_keys", H5T_NATIVE_CHAR, c.keys.data(), rows(c.keys.size()), 1);
  write_array(file, "recipe_values", H5T_NATIVE_CHAR, c.values.data(),
              rows(c.values.size()), 1);

  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  H5Tset_size(text, std::strlen(format) + 1);
  write_attribute(file, "format", text, format);
  write_attribute(file, "version", H5T_NATIVE_INT, &version);
  write_attribute(file, "bond_limit", H5T_NATIVE_DOUBLE, &c.bond_limit);
  write_attribute(file, "porosity", H5T_NATIVE_DOUBLE, &c.porosity);
  write_attribute(file, "whole_porosity", H5T_NATIVE_DOUBLE, &c.whole_porosity);
  write_attribute(file, "overlap", H5T_NATIVE_DOUBLE, &c.overlap);
  write_attribute(file, "pressure", H5T_NATIVE_DOUBLE, &c.pressure);
  write_attribute(file, "friction", H5T_NATIVE_DOUBLE, &c.friction);
  file.finish("write " + path.string());
  seal(path);
}

Columns read_columns(const std::filesystem::path& path)
{
  if (!std::filesystem::exists(path)) throw InputError("there is no such file");
  if (!std::filesystem::is_regular_file(path)) throw InputError("is not a file");
  const Quiet quiet;
  check_seal(path);
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0)
    throw InputError("is damaged or truncated; make it again with `mergel sample`");
  const Handle file(id, H5Fclose, "open it");

  Columns c;
  int found = 0;
  try {
    read_attribute(file, "version", H5T_NATIVE_INT, &found);
    if (found != version)
      throw InputError("has sample format " + std::to_string(found) +
                       ", this program reads " + std::to_string(version) +
                       "; make it again with `mergel sample`");
    c.x = read_array<double>(file, "x", H5T_NATIVE_DOUBLE, 3);
    c.R = read_array<double>(file, "R", H5T_NATIVE_DOUBLE, 1);
    c.m = read_array<double>(file, "m", H5T_NATIVE_DOUBLE, 1);
    c.S = read_array<double>(file, "S", H5T_NATIVE_DOUBLE, 1);
    c.bonds = read_array<std::uint32_t>(file, "bonds", H5T_NATIVE_UINT32, 2);
    c.shifts = read_array<std::int16_t>(file, "bond_shifts", H5T_NATIVE_INT16, 3);
    c.cell = read_array<double>(file, "cell", H5T_NATIVE_DOUBLE, 1);
    const auto text = [&](const char* name) {
      const auto chars = read_array<char>(file, name, H5T_NATIVE_CHAR, 1);
      return std::string(chars.begin(), chars.end());
    };
    c.keys = text("recipe_keys");
    c.values = text("recipe_values");
    read_attribute(file, "bond_limit", H5T_NATIVE_DOUBLE, &c.bond_limit);
    read_attribute(file, "porosity", H5T_NATIVE_DOUBLE, &c.porosity);
    read_attribute(file, "whole_porosity", H5T_NATIVE_DOUBLE, &c.whole_porosity);
    read_attribute(file, "overlap", H5T_NATIVE_DOUBLE, &c.overlap);
    read_attribute(file, "pressure", H5T_NATIVE_DOUBLE, &c.pressure);
    read_attribute(file, "friction", H5T_NATIVE_DOUBLE, &c.friction);
  } catch (const NumericalError& e) {
    throw InputError(std::string("is damaged (") + e.what() +
                     "); make it again with `mergel sample`");
  }
  const std::size_t n = c.R.size();
  bool fits = c.x.size() == 3 * n && c.m.size() == n && c.S.size() == n &&
              c.cell.size() == 3 && 2 * c.shifts.size() == 3 * c.bonds.size();
  for (const std::uint32_t id_of_end : c.bonds) fits = fits && id_of_end < n;
  if (!fits) throw InputError("is damaged (its arrays do not fit each other)");
  return c;
}

} // namespace

void write_sample(const std::filesystem::path& file, const Sample& sample)
{
  const Columns c = to_columns(sample);
  replace_file(file, [&](const std::filesystem::path& path) { write_columns(path, c); });
}

Sample read_sample(const std::filesystem::path& file)
{
  const Columns c = read_columns(file);
  Sample s;
  for (std::size_t i = 0; i < c.R.size(); ++i) {
    Body b;
    b.x = {c.x[3 * i], c.x[3 * i + 1], c.x[3 * i + 2]};
    b.R = c.R[i];
    b.m = c.m[i];
    b.S = c.S[i];
    s.packing.particles.add(b);
  }
  for (std::size_t k = 0; k < c.bonds.size() / 2; ++k)
    s.bonding.pairs.push_back(
        {c.bonds[2 * k],
         c.bonds[2 * k + 1],
         {c.shifts[3 * k], c.shifts[3 * k + 1], c.shifts[3 * k + 2]}});
  s.packing.cell.size = {c.cell[0], c.cell[1], c.cell[2]};
  s.bonding.limit = c.bond_limit;
  s.packing.porosity = c.porosity;
  s.packing.whole_porosity = c.whole_porosity;
  s.packing.overlap = c.overlap;
  s.packing.pressure = c.pressure;
  s.packing.friction = c.friction;
  const auto keys = lines(c.keys), values = lines(c.values);
  for (std::size_t k = 0; k < std::min(keys.size(), values.size()); ++k)
    s.recipe.emplace_back(keys[k], values[k]);
  return s;
}

std::string difference(const Sample& sample,
                       const std::vector<std::pair<std::string, std::string>>& recipe)
{
  for (std::size_t k = 0; k < std::max(recipe.size(), sample.recipe.size()); ++k) {
    if (k >= recipe.size() || k >= sample.recipe.size() ||
        recipe[k].first != sample.recipe[k].first)
      return "was made by another version of the program";
    if (recipe[k].second != sample.recipe[k].second)
      return "was made with " + recipe[k].first + " = " + sample.recipe[k].second +
             ", the case asks for " + recipe[k].second;
  }
  return "";
}

} // namespace mergel::dem
