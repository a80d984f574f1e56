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
/// Those of a particle: one, or of a polyhedron one at each feature.
/// @pre the contact is closed (overlap > 0)
/// @throws NumericalError for a centre inside the wall
std::vector<RigidContact> read_contacts(const RigidWall& wall, const WallContact& contact,
                                        const Particles& p);

/// Radius of a pile at the height z above its lowest point [m]; 0 below it, and of a plane. Of a
/// polyhedron that of the circle with the area of the section.
double radius_at(const RigidShape& shape, double z);
/// Height of the shoulder above the lowest point [m]; 0 of a plane.
double tip_height(const RigidShape& shape);

} // namespace mergel::dem
