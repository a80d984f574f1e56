/// HDF5 files that come close to a good one: its names, with shapes, types, layouts, links
/// and values that it does not have.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mergel::fuzz {

/// An array of the good file.
struct CraftedArray {
  std::string name;
  hid_t type; ///< native
  std::vector<hsize_t> size;
  std::vector<double> values;
};

/// How many bytes a good array takes of those that choose.
inline std::size_t n_choices(const CraftedArray& a)
{
  return a.size.size() + 5;
}

/// An attribute of the good file: a number, or a text if there is one.
struct CraftedAttribute {
  std::string name;
  hid_t type; ///< native; of a number
  double number;
  std::string text = {};
};

/// Write the file. The bytes choose, name by name, shape, type, layout, link and values;
/// bytes that are missing count as 0, and all zeros make the good file.
void craft_hdf5(const std::filesystem::path& file, const std::vector<CraftedArray>& arrays,
                const std::vector<CraftedAttribute>& attributes, const std::string& bytes);

} // namespace mergel::fuzz
