/// Files that carry a right sum and are no sample, or an odd one: what a reader must not
/// trust although the seal holds.
#pragma once

#include <filesystem>
#include <string>

namespace mergel::fuzz {

/// Write a sealed HDF5 file with the names of a sample. The bytes choose, name by name,
/// shape, type, layout, link and values; bytes that are missing count as 0, and all zeros make a
/// good sample of three grains.
void craft_sample(const std::filesystem::path& file, const std::string& bytes);

} // namespace mergel::fuzz
