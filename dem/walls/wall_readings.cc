#include "dem/walls/wall_readings.h"

namespace mergel::dem {

double pull(const MirrorPair& pair, const PairMaterials& material, const Particles& p)
{
  const ParticleState& b = p.state[pair.particle];
  const double gap = 2.0 * (b.x.y() - b.R); // to the image
  double force = 0.0;
  if (pair.bond.intact > 0.0) {
    const auto shape = bond_shape(section(material.bond), b.R, 0.5 / b.R);
    force += pair.bond.intact * shape.k_n * (gap - pair.gap_0 - pair.bond.u_p);
  }
  const double overlap = activation_gap(material.contact) * b.S - gap;
  if (overlap > 0.0) force -= normal_force(material.contact, sides_at_mirror(b.R), overlap);
  return force;
}

RigidContact read_contact(const RigidWall& wall, const WallContact& contact,
                          const Particles& p)
{
  const ParticleState& b = p.state[contact.particle];
  const SurfacePoint at = closest_point(wall, b);
  const double f_n = normal_force(wall.material, sides_at_wall(b.R), contact.overlap);
  return {contact.f_s - f_n * at.n, at.point, at.part};
}

double radius_at(const Revolution& shape, double z)
{
  if (z <= 0.0) return 0.0;
  for (std::size_t k = 1; k < shape.profile.size(); ++k) {
    const auto &a = shape.profile[k - 1], &b = shape.profile[k];
    if (z < b.z) return a.r + (b.r - a.r) * (z - a.z) / (b.z - a.z); // b.z > z >= a.z
  }
  return shape.R();
}

} // namespace mergel::dem
