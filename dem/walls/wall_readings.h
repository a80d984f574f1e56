/// Forces of single particles at mirrors and rigid walls after a step, for output.
#pragma once

#include "dem/walls/mirror.h"
#include "dem/walls/rigid_wall.h"

namespace mergel::dem {

/// Force on a particle towards its mirror image, of bond and contact [N]; negative in compression.
double pull(const MirrorPair& pair, const PairMaterials& material, const Particles& p);

/// One contact of a rigid wall.
struct RigidContact {
  Vec3 f = Vec3::Zero();     ///< on the particle [N]
  Vec3 point = Vec3::Zero(); ///< of the wall, where -f acts [m]
  std::size_t part = 0;      ///< of the wall
};
/// @pre the contact is closed (overlap > 0)
/// @throws NumericalError for a centre inside the wall
RigidContact read_contact(const RigidWall& wall, const WallContact& contact,
                          const Particles& p);

/// Radius of a body of revolution at the height z above its lowest point [m]; 0 below it.
double radius_at(const Revolution& shape, double z);

} // namespace mergel::dem
