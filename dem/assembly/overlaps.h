/// How far particles overlap: a reading, and the limit at which a run stops.
#pragma once

#include "dem/assembly/assembly.h"

namespace mergel::dem {

/// Largest overlap of two particles over the smaller radius, and how many pairs lie beyond two
/// marks. Particles of a soft contact overlap by 0.1 to 0.3 under the tip of a pile.
struct Overlaps {
  static constexpr double mark = 0.3, high_mark = 0.5; ///< [-]

  double largest = 0.0; ///< [-]; 0 without any
  std::size_t beyond_mark = 0, beyond_high_mark = 0;

  /// Keep the larger of each.
  void add(const Overlaps& other);
};

/// The overlaps of all ranks; collective.
/// @throws Unstable naming two particles that overlap by more than
///   assembly.motion.largest_overlap, and the remedy
Overlaps check_overlaps(const Assembly& assembly);

} // namespace mergel::dem
