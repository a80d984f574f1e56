/// HDF5 files similar to a good one: the same names with other shapes, types, layouts,
/// links and values.
#pragma once

#include "dem/io/seal.h"

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

/// Number of choosing bytes that a good array uses.
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

/// Writes the file, with a user block for the seal. The bytes choose, name by name, shape,
/// type, layout, link and values; missing bytes count as 0, and all zeros make the good file.
void craft_hdf5(const std::filesystem::path& file, const std::vector<CraftedArray>& arrays,
                const std::vector<CraftedAttribute>& attributes, const std::string& bytes);

/// Seals such a file.
void seal_crafted(const std::filesystem::path& file, const dem::Seal& seal);

} // namespace mergel::fuzz
