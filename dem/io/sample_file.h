/// Specimens on disk (HDF5): grains and bonds, and what they were made from.
#pragma once

#include "dem/specimen/bonding.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mergel::dem {

/// A specimen as it is stored: unloaded, at rest.
struct Sample {
  Packing packing;
  Bonding bonding;
  /// What fixed it: (key, value) in a fixed order, compared word for word when it is
  /// reused.
  std::vector<std::pair<std::string, std::string>> recipe;
  std::uint64_t sum = 0; ///< that seals the file it was read from; 0 when it was made
};

/// Datasets `x` (N x 3, m), `R` (N, m), `m` (N, kg), `S` (N), `bonds` (N_bonds x 2, ids),
/// `bond_shifts` (N_bonds x 3, edges of the cell that the second grain's image is away), `cell`
/// (3, m, edges of the periodic cell; 0: not periodic), `recipe_keys`, `recipe_values`;
/// attributes `format`, `version`, `bond_limit`, `porosity`, `whole_porosity`, `overlap`,
/// `pressure` (Pa), `friction` (while packed). After the HDF5 data, which readers of HDF5 do not
/// see, stands the FNV-1a sum of all bytes. The same sample is
/// the same file, byte for byte. It is replaced whole.
/// @throws NumericalError when it cannot be written
void write_sample(const std::filesystem::path& file, const Sample& sample);

/// @throws InputError, without the file's name in front, when it is missing, is no
///   sample, is damaged or truncated, or of a newer version
Sample read_sample(const std::filesystem::path& file);

/// "" when the recipes agree, else a clause that names the first difference: "... was made
/// with porosity = 0.52, the case asks for 0.5".
std::string difference(const Sample& sample,
                       const std::vector<std::pair<std::string, std::string>>& recipe);

} // namespace mergel::dem
