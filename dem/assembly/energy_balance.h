/// The energy book of a rock: what was put in is stored or lost.
#pragma once

#include "dem/assembly/step.h"

namespace mergel::dem {

/// All terms [J], at the whole step of the positions.
struct EnergyBook {
  double kinetic = 0.0, bonds = 0.0, contacts = 0.0, walls = 0.0, mirror = 0.0; ///< stored
  double gravity = 0.0, wall_work = 0.0, pile_work = 0.0, cell_work = 0.0;      ///< put in
  double slip = 0.0, plastic = 0.0, residue = 0.0, lock = 0.0, damping = 0.0;   ///< lost

  double stored() const { return kinetic + bonds + contacts + walls + mirror; }
  double put_in() const { return gravity + wall_work + pile_work + cell_work; }
  double lost() const { return slip + plastic + residue + lock + damping; }
};

/// Velocities are half a step behind: kinetic energy and works are carried over the missing
/// half step by the forces that act now, without moving the rock. Else the power of half a
/// step is missing, which shows when a moving wall first meets a grain.
/// @param dt present step [s]
EnergyBook energy_book(const Rock& rock, double dt);

/// Energy that the book cannot explain since `start` [J]: growth of what is stored, less
/// what was put in, plus what was lost.
double unexplained(const EnergyBook& now, const EnergyBook& start);

} // namespace mergel::dem
