/// Displacement of particles and far field since the first frame of a run.
#pragma once

#include "apps/view/results.h"

namespace mergel::apps {

inline constexpr const char* displacement_array = "displacement since frame 0";

/// Gives particles and far field of `frame` the point array `displacement_array`: the
/// distance moved since `start` [mm]. Particles are identified by their id.
/// @returns the distance below which 98 % of the particles stay [mm]; debris moves further
/// @throws InputError when the two frames are not of one run
double add_displacement(const ResultFrame& start, ResultFrame& frame);

} // namespace mergel::apps
