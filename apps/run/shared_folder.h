/// Checks that all ranks see the same results folder.
#pragma once

#include <filesystem>

namespace mergel::apps {

/// Create a file there, look for it on every rank and remove it. All ranks write a
/// checkpoint together, so without this check a node with another folder under that name
/// would be found only at the first checkpoint. Collective; does nothing on one rank.
/// @throws InputError naming a rank and its node
void require_shared(const std::filesystem::path& folder);

} // namespace mergel::apps
