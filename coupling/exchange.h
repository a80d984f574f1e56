/// What passes between a structure and its wall: forces up, velocities down
/// (coupling/README.md, Exchange).
#pragma once

#include "coupling/structure.h"

namespace mergel::coupling {

/// Moves the wall of an assembly with a structure, one step of it per DEM step.
class Exchange {
public:
  /// Borrows the structure, which must outlive it.
  Exchange(Transfer transfer, Structure& structure);

  /// Up: the forces of the wall nodes, summed to the nodes of the structure, f_s = N^T
  /// f_wall; where nodes are shared those of this rank.
  const Nodal& sum_forces(const dem::Wall& wall);

  /// One step of the structure over dt [s] under the forces that were summed last.
  void step_structure(double dt);

  /// Down: the wall nodes get the velocities of the structure, v_wall = N v_s, and move
  /// with them over dt [s].
  /// @throws NumericalError on all ranks alike for a velocity that is not finite
  void move_wall(dem::Wall& wall, double dt);

  /// Static solution of a structure that has not moved yet, under the present wall forces
  /// (coupling/README.md, Start of a coupled run). Moves the wall nodes by it and sets
  /// their velocities to zero. Returns the displacements of the wall nodes [m]; none for a
  /// structure without such a solution.
  std::optional<Nodal> settle(dem::Wall& wall);

  const Structure& structure() const { return structure_; }
  const Transfer& transfer() const { return transfer_; }

  /// Wall-clock time spent in the structure and in the exchange itself [s].
  double structure_seconds = 0.0, exchange_seconds = 0.0;

private:
  Transfer transfer_;
  Structure& structure_;
  Nodal f_wall_, f_s_, v_s_;
};

/// Displacement at a point of a region whose boundary nodes x have moved by u [m]:
/// inverse-distance weights of power 3, exact for translations.
dem::Vec3 interpolate_inside(const Nodal& x, const Nodal& u, const dem::Vec3& at);

} // namespace mergel::coupling
