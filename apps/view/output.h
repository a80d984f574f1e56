/// Where the pictures of a command go, and what names its runs in them.
#pragma once

#include "apps/view/options.h"
#include "apps/view/page.h"
#include "apps/view/run_name.h"

#include <filesystem>
#include <vector>

namespace mergel::apps {

/// The folder of the pictures; made if it does not exist.
std::filesystem::path picture_folder(const Options& options);

/// A picture replaces an earlier one.
/// @throws InputError when it would replace another file
void save(Page& page, const std::filesystem::path& png);

/// The names of runs that are drawn over each other.
std::vector<RunName> run_names(const Options& options);

} // namespace mergel::apps
