/// The value of --walltime.
#pragma once

#include <string>

namespace mergel::apps {

/// "4h", "30 min", "4:00:00" or, as Slurm writes it, "1-12:00:00" or "1-12" [s].
/// @throws InputError unless it is a time above 0
double to_walltime(const std::string& text);

} // namespace mergel::apps
