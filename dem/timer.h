/// Wall-clock time, for summaries, checkpoints and benchmarks; never for physics.
#pragma once

namespace mergel::dem {

/// Seconds since an arbitrary instant.
double wall_clock();

/// Time spent in the parts of a step [s].
struct StepTimes {
  double motion = 0.0, lists = 0.0, bonds = 0.0, contacts = 0.0, walls = 0.0,
         exchange = 0.0; ///< with other ranks

  double total() const { return motion + lists + bonds + contacts + walls + exchange; }
};

} // namespace mergel::dem
