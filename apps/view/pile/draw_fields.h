/// Pictures of the continuum fields around a pile: stress.png, porosity.png, layers.png,
/// principal.png and chains.png.
#pragma once

#include "apps/view/options.h"
#include "apps/view/results.h"

#include <filesystem>
#include <string>

namespace mergel::apps {

/// @param porosity_at_start before the penetration [-]
/// @param caption above each picture
void draw_fields(const Options& options, const std::filesystem::path& output,
                 const ResultFrame& frame, const ContinuumFrame& continuum,
                 double porosity_at_start, const std::string& caption);

} // namespace mergel::apps
