/// All lines along which an assembly transmits forces: between particles, to mirror images, to
/// triangulated walls and to rigid walls.
#pragma once

#include "dem/assembly/assembly.h"

#include <vector>

namespace mergel::dem {

/// What a branch leads to from the centre of its particle.
enum class BranchEnd {
  particle, ///< the centre of the particle j
  image,    ///< the symmetry plane y = 0, beside the particle
  wall,     ///< a point of a triangulated wall
  rigid     ///< a point of a rigid wall
};

/// The net force of all that acts along one branch.
struct LoadedBranch {
  Index i = 0, j = 0; ///< j = i where it leads to no particle
  BranchEnd end = BranchEnd::particle;
  Vec3 r = Vec3::Zero(); ///< from the centre of i [m]
  Vec3 F = Vec3::Zero(); ///< on i [N]
  Shift shift{};         ///< of j, where it is an image through a face of a periodic cell

  double normal_force() const ///< compression positive [N]
  {
    const double length = r.norm();
    return length > 0.0 ? -F.dot(r) / length : 0.0;
  }
};

/// The forces between particles and triangulated walls in the last step, of all ranks on the
/// first, in an order that does not depend on the ranks; nothing on the others. Collective.
std::vector<WallContactForce> gather_wall_forces(const Assembly& assembly);

/// The branches of a gathered assembly; bonds that are intact but bear no load are among them.
/// Not collective.
/// @param at_walls of gather_wall_forces()
/// @throws NumericalError for a centre inside a rigid wall
std::vector<LoadedBranch> loaded_branches(const Assembly& assembly,
                                          const std::vector<WallContactForce>& at_walls);

/// Number of branches to particles and images of each particle [-]: its coordination number.
std::vector<double> coordination(const Particles& p,
                                 const std::vector<LoadedBranch>& branches);

} // namespace mergel::dem
