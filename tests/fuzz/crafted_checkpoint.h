/// Checkpoints with a right sum and odd contents, and a good one.
#pragma once

#include <filesystem>
#include <string>

namespace mergel::fuzz {

/// Write the checkpoint of the rock of tests/support/rock_with_everything.h on its way.
void write_good_checkpoint(const std::filesystem::path& file);

/// The same, with what the bytes choose (crafted_hdf5.h), sealed. The first byte tells the
/// array to begin with, for there are many; 255 leaves all of them as they are.
void craft_checkpoint(const std::filesystem::path& file, const std::string& bytes);

} // namespace mergel::fuzz
