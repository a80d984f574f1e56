#include "tests/fuzz/crafted_sample.h"

#include "tests/fuzz/crafted_hdf5.h"
#include "tests/fuzz/reader.h"

#include <cstdint>
#include <fstream>
#include <iterator>

namespace mergel::fuzz {

namespace {

constexpr std::size_t n_particles = 3;

std::vector<CraftedArray> good_arrays()
{
  const hid_t number = H5T_NATIVE_DOUBLE, text = H5T_NATIVE_CHAR;
  return {
      {"x", number, {n_particles, 3}, {0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.2, 0.0, 0.0}},
      {"R", number, {n_particles}, {0.05, 0.05, 0.05}},
      {"m", number, {n_particles}, {1.0, 1.0, 1.0}},
      {"S", number, {n_particles}, {1.0, 2.0, 3.0}},
      {"bonds", H5T_NATIVE_UINT32, {2, 2}, {0.0, 1.0, 1.0, 2.0}},
      {"recipe_keys", text, {2}, {'a', '\n'}},
      {"recipe_values", text, {2}, {'b', '\n'}},
      {"bond_shifts", H5T_NATIVE_INT16, {2, 3}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}},
      {"cell", number, {3}, {0.0, 0.0, 0.0}},
  };
}

std::vector<CraftedAttribute> good_attributes()
{
  std::vector<CraftedAttribute> all{{"version", H5T_NATIVE_INT, 2.0}};
  for (const char* name :
       {"bond_limit", "porosity", "whole_porosity", "overlap", "pressure", "friction"})
    all.push_back({name, H5T_NATIVE_DOUBLE, 0.1});
  return all;
}

/// The end of a sample file, after the data of HDF5.
std::string seal_of(const std::string& bytes)
{
  std::uint64_t sum = 0xcbf29ce484222325u; // FNV-1a
  for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  std::string hex;
  for (int shift = 60; shift >= 0; shift -= 4)
    hex += "0123456789abcdef"[(sum >> shift) & 15u];
  return "mergel sample, FNV-1a " + hex;
}

} // namespace

void craft_sample(const std::filesystem::path& path, const std::string& bytes)
{
  craft_hdf5(path, good_arrays(), good_attributes(), bytes);
  std::ifstream in(path, std::ios::binary);
  std::string whole((std::istreambuf_iterator<char>(in)), {});
  in.close();
  write_bytes(path, whole + seal_of(whole));
}

} // namespace mergel::fuzz
