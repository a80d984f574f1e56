/// Books of the interface: force, moment and power must leave one side as they reach the
/// other.
#pragma once

#include "coupling/exchange.h"
#include "dem/parallel/reduction.h"

namespace mergel::coupling {

/// Relative differences between what the rock feels from the wall and what the far field
/// gets [-].
struct InterfaceBalance {
  double force = 0.0;  ///< |sum f_fem + sum f_grains| / sum |f_wall|
  double moment = 0.0; ///< about the origin, over sum |x| |f_wall|
  double power =
      0.0; ///< |sum f_fem.v_fem - power at the points of action| / sum |f_wall| |v_wall|
};

/// Of the last forces, at the positions and velocities of the wall at which they were
/// computed: call after the forces and before the wall moves.
///
/// A lip follows its nodes without turning, so contacts on the lip leave the moment of
/// force times lip height; everything else balances to round-off. Collective.
/// @param comm of the rock whose wall it is
InterfaceBalance interface_balance(Exchange& exchange, const dem::Wall& wall,
                                   const Nodal& x_fem, const dem::Communicator& comm);

} // namespace mergel::coupling
