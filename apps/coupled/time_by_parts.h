/// What the parts of a coupled step cost.
#pragma once

#include "apps/run/protocol.h"
#include "coupling/coupled_system.h"

#include <string>

namespace mergel::apps {

/// Time of a step, and the parts of it in per cent; nothing without a step.
/// @param structures what the structures are called: "far field"
std::string time_by_parts(const coupling::CoupledSystem& coupled, const Work& work,
                          const char* structures);

} // namespace mergel::apps
