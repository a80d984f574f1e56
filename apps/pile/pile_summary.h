/// Summary of an installation: summary.json and the text on std::cout.
#pragma once

#include "apps/pile/installation.h"

namespace mergel::apps {

/// Number of particles above the collar. They are followed, but no wall catches them.
/// Collective.
/// @param collar_height of the rim above the surface [m]
std::size_t count_debris(const dem::Assembly& assembly, double collar_height);

/// Steps since this start of the program, seconds of the whole run including earlier
/// starts.
struct Work {
  std::size_t n_steps;
  double seconds;
};

/// @param seconds of the whole run
/// @param failure message of the failure that ended the run, or empty
/// @throws NumericalError when it cannot be written
void write_summary(const std::filesystem::path& file, const Installation& run,
                   const coupling::CoupledSystem& coupled, std::size_t n_debris,
                   double seconds, const std::string& failure);

void print_summary(const std::filesystem::path& folder, const PileCase& c,
                   const Installation& run, const coupling::CoupledSystem& coupled,
                   std::size_t n_debris, const Work& work);

} // namespace mergel::apps
