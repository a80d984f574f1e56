/// What a checkpoint of a workload costs.
#pragma once

#include "apps/bench/workloads.h"

#include <filesystem>

namespace mergel::apps {

/// Write a checkpoint of the workload to `file` and read it back, three times, and print
/// the seconds of each and the bytes a particle and pair. The file stays. Collective.
void measure_checkpoint(const WorkloadSpec& spec, const std::filesystem::path& file);

} // namespace mergel::apps
