/// What is left to say when a pile stands at its final depth: summary.json, and words.
#pragma once

#include "apps/pile/installation.h"

namespace mergel::apps {

/// Grains that flew over the rim of the interface; they are followed, but nothing catches
/// them. Collective.
/// @param lip height of the rim above the surface [m]
std::size_t count_debris(const dem::Rock& rock, double lip);

/// Steps of this start of the program, seconds of the whole run.
struct Work {
  std::size_t n_steps;
  double seconds;
};

/// @param seconds of the whole run
/// @param failure that ended the run before its time, or empty
/// @throws NumericalError when it cannot be written
void write_summary(const std::filesystem::path& file, const Installation& run,
                   const CoupledRock& coupled, std::size_t n_debris, double seconds,
                   const std::string& failure);

void print_summary(const std::filesystem::path& folder, const PileCase& c,
                   const Installation& run, const CoupledRock& coupled,
                   std::size_t n_debris, const Work& work);

} // namespace mergel::apps
