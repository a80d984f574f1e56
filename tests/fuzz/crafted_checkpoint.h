/// Checkpoints with a correct checksum and unusual contents, and a good one.
#pragma once

#include <filesystem>
#include <string>

namespace mergel::fuzz {

/// Writes a checkpoint of the assembly of tests/support/assembly_with_everything.h.
void write_good_checkpoint(const std::filesystem::path& file);

/// The same, changed as the bytes choose (crafted_hdf5.h), and sealed. The first byte
/// selects the array to begin with, because there are many; 255 leaves all of them
/// unchanged.
void craft_checkpoint(const std::filesystem::path& file, const std::string& bytes);

} // namespace mergel::fuzz
