#include "tests/fuzz/crafted_sample.h"

#include "tests/fuzz/crafted_hdf5.h"

#include <string_view>

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

} // namespace

void craft_sample(const std::filesystem::path& path, const std::string& bytes)
{
  craft_hdf5(path, good_arrays(), good_attributes(), bytes);
  seal_crafted(
      path, {"sample", "FNV-1a", "", [](std::string_view of) { return dem::fnv_1a(of); }});
}

} // namespace mergel::fuzz
