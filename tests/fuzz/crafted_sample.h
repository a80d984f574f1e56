/// Files with a correct checksum that are no sample, or an unusual one: a reader must not
/// trust them although the seal is valid.
#pragma once

#include <filesystem>
#include <string>

namespace mergel::fuzz {

/// Writes a sealed HDF5 file with the names of a sample. The bytes choose, name by name,
/// shape, type, layout, link and values; missing bytes count as 0, and all zeros make a
/// good sample of three particles.
void craft_sample(const std::filesystem::path& file, const std::string& bytes);

} // namespace mergel::fuzz
