/// Sample files: specimens on disk (HDF5) with particles, bonds and recipe.
#pragma once

#include "dem/specimen/bonding.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mergel::dem {

/// A specimen as stored: unloaded, at rest.
struct Sample {
  Packing packing;
  Bonding bonding;
  /// The keys and values that determine it, in a fixed order; compared as texts when the
  /// sample is reused.
  std::vector<std::pair<std::string, std::string>> recipe;
  std::uint64_t sum = 0; ///< checksum of the file it was read from; 0 if not read
};

/// Datasets `x` (N x 3, m), `R` (N, m), `m` (N, kg), `S` (N), `bonds` (N_bonds x 2, ids),
/// `bond_shifts` (N_bonds x 3, shift of the second particle's image in edges of the cell),
/// `cell` (3, m, edges of the periodic cell; 0: not periodic), `recipe_keys`,
/// `recipe_values`; attributes `format`, `version`, `bond_limit`, `porosity`,
/// `whole_porosity`, `overlap`, `pressure` (Pa), `friction` (while packed). The FNV-1a
/// checksum of the data is in the user block of HDF5 (dem/io/seal.h). Equal samples give
/// equal files, byte for byte. The file is replaced atomically.
/// @throws NumericalError when it cannot be written
void write_sample(const std::filesystem::path& file, const Sample& sample);

/// @throws InputError, without the file's name in front, when the file is missing, is no
///   sample, is damaged or truncated, or has another format version
Sample read_sample(const std::filesystem::path& file);

/// "" when the recipes agree, else a clause that names the first difference: "... was made
/// with porosity = 0.52, the case asks for 0.5".
std::string difference(const Sample& sample,
                       const std::vector<std::pair<std::string, std::string>>& recipe);

} // namespace mergel::dem
