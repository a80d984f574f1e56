/// Summary of an installation.
#pragma once

#include "apps/pile/installation.h"
#include "apps/run/protocol.h"

namespace mergel::apps {

/// Number of particles above the collar. They are followed, but no wall catches them.
/// Collective.
/// @param collar_height of the rim above the surface [m]
std::size_t count_debris(const dem::Assembly& assembly, double collar_height);

/// Add the results of an installation. Collective.
void summarise(Summary& summary, const PileCase& c, const Installation& run,
               const coupling::CoupledSystem& coupled, const Work& work);

} // namespace mergel::apps
