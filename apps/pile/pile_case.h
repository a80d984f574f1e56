/// Case of `mergel pile`: coupled system, pile and output.
#pragma once

#include "apps/case/coupled_case.h"
#include "apps/run/checkpoint_scheduler.h"

namespace mergel::apps {

struct PileCase {
  CoupledCase assembly;

  // Pile
  enum class Tip { cone, flat } tip = Tip::cone;
  double diameter = unset;        ///< [m]
  double cone_angle = unset;      ///< full angle at the tip [rad]; unset for a flat tip
  double velocity = unset;        ///< downwards [m/s]
  double final_depth = unset;     ///< of the shoulder below the surface [m]
  double contact_modulus = unset; ///< [Pa]
  double friction = unset;        ///< [-]
  dem::ContactLaw contact;        ///< with the particles; set by complete()

  // Output
  double record_every = unset; ///< travel between lines of history.csv [m]
  int frames = 20;             ///< frames of the fields after the first
  CheckpointKey checkpoints;

  double tip_height() const; ///< from the lowest point to the shaft [m]; 0 for a flat tip
  /// From the tip at the surface to the shoulder at the final depth [m].
  double travel() const { return final_depth + tip_height(); }
};

void declare(CaseFile& file, PileCase& c);

/// @throws InputError naming file, line and key
void complete(CaseFile& file, PileCase& c);

} // namespace mergel::apps
