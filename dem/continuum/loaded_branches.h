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
  Vec3 r = Vec3::Zero();  ///< from the centre of i [m]
  Vec3 F = Vec3::Zero();  ///< on i [N]
  Shift shift{};          ///< of j, where it is an image through a face of a periodic cell
  bool is_bonded = false; ///< of a pair that was ever bonded

  double normal_force() const ///< compression positive [N]
  {
    const double length = r.norm();
    return length > 0.0 ? -F.dot(r) / length : 0.0;
  }
};

/// The branches of the particles that this rank owns, those to particles of other ranks among
/// them, in an order that does not depend on the ranks: bonded pairs, other pairs, images,
/// triangulated walls, rigid walls, each ascending. Bonds that are intact but bear no load are
/// among them. The forces at walls are those of the last step. Not collective.
/// @throws NumericalError for a centre inside a rigid wall
std::vector<LoadedBranch> loaded_branches(const Assembly& assembly);

/// The branches of all ranks that bear a load, each once, in the same order, on the rank `to`;
/// nothing on the others. Collective.
/// @param mine of loaded_branches()
std::vector<LoadedBranch> gather_loads(const Assembly& assembly,
                                       const std::vector<LoadedBranch>& mine, int to);

/// Number of branches to particles and images of each owned particle [-]: its coordination
/// number.
std::vector<double> coordination(const Particles& p,
                                 const std::vector<LoadedBranch>& branches);

} // namespace mergel::dem
