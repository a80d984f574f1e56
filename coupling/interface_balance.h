/// Interface balance: force, moment and power on the particles' side must equal those on
/// the side of the structure (coupling/README.md, Interface balance).
#pragma once

#include "coupling/exchange.h"
#include "dem/parallel/reduction.h"

namespace mergel::coupling {

/// Relative differences between the wall forces on the particles and the forces on the
/// structure [-].
struct InterfaceBalance {
  double force = 0.0;  ///< |sum f_s + sum f_particles| / sum |f_wall|
  double moment = 0.0; ///< about the origin, over sum |x| |f_wall|
  /// |sum f_s.v_s - power at the points of action| / sum |f_wall| |v_wall|
  double power = 0.0;
};

/// Balance of the last forces, at the wall positions and velocities at which they were
/// computed: call it after the forces and before the wall moves.
///
/// The collar does not rotate with the rim, so contacts on the collar leave a moment of
/// force times height. Everything else balances to round-off. Collective.
/// @param comm of the assembly to which the wall belongs
InterfaceBalance interface_balance(const Exchange& exchange, const dem::Wall& wall,
                                   const dem::Communicator& comm);

/// The larger of each difference.
InterfaceBalance worst(const InterfaceBalance& a, const InterfaceBalance& b);

} // namespace mergel::coupling
