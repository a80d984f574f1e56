/// The cost of a checkpoint of a workload.
#pragma once

#include "apps/bench/workloads.h"

#include <filesystem>

namespace mergel::apps {

/// Write a checkpoint of the workload to `file` and read it back, three times. Prints the
/// time of each and the bytes per particle and pair. The file is kept. Collective.
void measure_checkpoint(const WorkloadSpec& spec, const std::filesystem::path& file);

} // namespace mergel::apps
