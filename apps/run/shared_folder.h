/// A results folder is one and the same for all ranks.
#pragma once

#include <filesystem>

namespace mergel::apps {

/// Make a file there, look for it on every rank and remove it again: checkpoints are
/// written by all ranks at once, and the first of them is too late to learn that a node
/// has a folder of its own under that name. Collective; on one rank nothing is done.
/// @throws InputError naming a rank and its node
void require_shared(const std::filesystem::path& folder);

} // namespace mergel::apps
