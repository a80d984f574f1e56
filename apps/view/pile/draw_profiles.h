/// Profiles of a pile run at one frame: shaft.png (stresses along the shaft), profiles.png (rock
/// below the tip, and away from the pile), and paths.png (stress at points that the tip passes).
#pragma once

#include "apps/view/options.h"

#include <filesystem>
#include <string>

namespace mergel::apps {

/// A picture without lines at this time is left out, and said.
/// @param time of the frame [s]
void draw_profiles(const Options& options, const std::filesystem::path& output, double time,
                   const std::string& caption);

} // namespace mergel::apps
