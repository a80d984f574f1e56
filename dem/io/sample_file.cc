#include "dem/io/sample_file.h"

#include "dem/io/atomic_file.h"
#include "dem/io/hdf5/hdf5.h"
#include "dem/io/hdf5/open_bytes.h"
#include "dem/io/seal.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

using namespace hdf5;

namespace {

constexpr int version = 2;
const char* const format = "mergel sample";

const Seal sample_seal{"sample", "FNV-1a", "make it again with `mergel sample`",
                       [](std::string_view bytes) { return fnv_1a(bytes); }};

/// The arrays of a sample as stored in the file.
struct Columns {
  std::vector<double> x, R, m, S;
  std::vector<std::uint32_t> bonds;
  std::vector<std::int16_t> shifts;
  std::vector<double> cell;
  std::string keys, values; ///< one line each
  double bond_limit = 0.0, porosity = 0.0, whole_porosity = 0.0, overlap = 0.0,
         pressure = 0.0, friction = 0.0;
};

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
  for (const ParticleState& b : s.packing.particles.state) {
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

/// Bytes of the HDF5 file with an empty user block, made in memory: with a full disk HDF5
/// 1.10.8 crashes at the end of the program.
std::string hdf5_bytes(const Columns& c)
{
  const Quiet quiet;
  const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "describe a file");
  constexpr std::size_t growth = 1 << 16;
  H5Pset_fapl_core(in_memory, growth, false);
  const Handle creation = user_block(seal_room);
  Handle file(H5Fcreate(format, H5F_ACC_TRUNC, creation, in_memory), H5Fclose,
              "make a file in memory");
  write_array(file, "x", H5T_NATIVE_DOUBLE, c.x.data(), {c.R.size(), 3});
  write_array(file, "R", H5T_NATIVE_DOUBLE, c.R.data(), {c.R.size(), 1});
  write_array(file, "m", H5T_NATIVE_DOUBLE, c.m.data(), {c.R.size(), 1});
  write_array(file, "S", H5T_NATIVE_DOUBLE, c.S.data(), {c.R.size(), 1});
  write_array(file, "bonds", H5T_NATIVE_UINT32, c.bonds.data(), {c.bonds.size() / 2, 2});
  write_array(file, "bond_shifts", H5T_NATIVE_INT16, c.shifts.data(),
              {c.shifts.size() / 3, 3});
  write_array(file, "cell", H5T_NATIVE_DOUBLE, c.cell.data(), {3, 1});
  write_array(file, "recipe_keys", H5T_NATIVE_CHAR, c.keys.data(), {c.keys.size(), 1});
  write_array(file, "recipe_values", H5T_NATIVE_CHAR, c.values.data(),
              {c.values.size(), 1});

  write_text_attribute(file, "format", format);
  write_attribute(file, "version", H5T_NATIVE_INT, &version);
  write_attribute(file, "bond_limit", H5T_NATIVE_DOUBLE, &c.bond_limit);
  write_attribute(file, "porosity", H5T_NATIVE_DOUBLE, &c.porosity);
  write_attribute(file, "whole_porosity", H5T_NATIVE_DOUBLE, &c.whole_porosity);
  write_attribute(file, "overlap", H5T_NATIVE_DOUBLE, &c.overlap);
  write_attribute(file, "pressure", H5T_NATIVE_DOUBLE, &c.pressure);
  write_attribute(file, "friction", H5T_NATIVE_DOUBLE, &c.friction);
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) throw NumericalError("HDF5 cannot flush");
  // The image begins behind the user block.
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  const std::size_t n_data = size > 0 ? static_cast<std::size_t>(size) : 0;
  std::string bytes(seal_room + n_data, '\0');
  if (n_data == 0 || H5Fget_file_image(file, bytes.data() + seal_room, n_data) != size)
    throw NumericalError("HDF5 cannot give its bytes");
  file.finish("close a file in memory");
  return bytes;
}

Pair bond_of(const Columns& c, std::size_t b)
{
  return {c.bonds[2 * b],
          c.bonds[2 * b + 1],
          {c.shifts[3 * b], c.shifts[3 * b + 1], c.shifts[3 * b + 2]}};
}

/// @throws InputError when the arrays do not fit each other, or a particle or bond is not
///   valid
void check(const Columns& c)
{
  const std::size_t n = c.R.size(), n_bonds = c.bonds.size() / 2;
  bool fits = c.x.size() == 3 * n && c.m.size() == n && c.S.size() == n &&
              c.cell.size() == 3 && c.shifts.size() == 3 * n_bonds;
  fits = fits && std::count(c.keys.begin(), c.keys.end(), '\n') ==
                     std::count(c.values.begin(), c.values.end(), '\n');
  for (const double edge : c.cell) fits = fits && std::isfinite(edge) && edge >= 0.0;
  for (std::size_t b = 0; fits && b < n_bonds; ++b) {
    const Pair q = bond_of(c, b);
    fits = q.i < q.j && q.j < n && (b == 0 || bond_of(c, b - 1) < q); // none twice
  }
  if (!fits) throw InputError("is damaged (its arrays do not fit each other)");

  for (std::size_t i = 0; i < n; ++i) {
    const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
    bool is_particle = is_positive(c.R[i]) && is_positive(c.m[i]) && is_positive(c.S[i]);
    for (std::size_t a = 3 * i; a < 3 * i + 3; ++a)
      is_particle = is_particle && std::isfinite(c.x[a]);
    if (!is_particle)
      throw InputError("is damaged (particle " + std::to_string(i) +
                       " has no valid position, radius, mass or S); make it again with "
                       "`mergel sample`");
  }
}

Columns read_columns(const std::filesystem::path& path, std::uint64_t& sum)
{
  const Quiet quiet;
  std::string bytes = unsealed(path, sample_seal, &sum);
  Columns c;
  int found = 0;
  try {
    const OpenBytes memory(bytes, path); // the bytes of which the checksum was computed
    const hid_t file = memory.file();
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
  check(c);
  return c;
}

} // namespace

void write_sample(const std::filesystem::path& file, const Sample& sample)
{
  replace_file(file, sealed(hdf5_bytes(to_columns(sample)), sample_seal));
}

Sample read_sample(const std::filesystem::path& file)
{
  Sample s;
  const Columns c = read_columns(file, s.sum);
  for (std::size_t i = 0; i < c.R.size(); ++i) {
    ParticleState b;
    b.x = {c.x[3 * i], c.x[3 * i + 1], c.x[3 * i + 2]};
    b.R = c.R[i];
    b.m = c.m[i];
    b.S = c.S[i];
    s.packing.particles.add(b);
  }
  for (std::size_t b = 0; b < c.bonds.size() / 2; ++b)
    s.bonding.pairs.push_back(bond_of(c, b));
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
