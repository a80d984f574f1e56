#include "dem/walls/wall_readings.h"

#include "dem/walls/feature_forces.h"

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

namespace {

/// Of the features of a triangulated polyhedron.
std::vector<RigidContact> read_features(const RigidWall& wall, const WallContact& contact,
                                        const ParticleState& b)
{
  const auto& polyhedron = std::get<Polyhedron>(wall.shape);
  FeaturesOfWall features(wall);
  std::vector<ActingFeature> acting;
  for (const PatchFeature& f :
       features.find(b.x, b.R + activation_gap(wall.material) * b.S))
    acting.push_back({&f, Vec3::Zero()});
  std::vector<RigidContact> read;
  if (acting.empty()) return read;
  share_forces(acting, sum_features(wall.material, acting, b.R), contact.f_s);
  for (const ActingFeature& a : acting) {
    const Vec3& point = a.feature->point;
    read.push_back({a.force, point, polyhedron.part_at(wall.seen(point))});
  }
  return read;
}

double radius_of(const Revolution& shape, double z)
{
  if (z <= 0.0) return 0.0;
  for (std::size_t k = 1; k < shape.profile.size(); ++k) {
    const auto &a = shape.profile[k - 1], &b = shape.profile[k];
    if (z < b.z) return a.r + (b.r - a.r) * (z - a.z) / (b.z - a.z); // b.z > z >= a.z
  }
  return shape.R();
}

} // namespace

std::vector<RigidContact> read_contacts(const RigidWall& wall, const WallContact& contact,
                                        const Particles& p)
{
  const ParticleState& b = p.state[contact.particle];
  if (std::holds_alternative<Polyhedron>(wall.shape))
    return read_features(wall, contact, b);
  const SurfacePoint at = closest_point(wall, b);
  const double f_n = normal_force(wall.material, sides_at_wall(b.R), contact.overlap);
  return {{contact.f_s - f_n * at.n, at.point, at.part}};
}

double radius_at(const RigidShape& shape, double z)
{
  if (const auto* polyhedron = std::get_if<Polyhedron>(&shape))
    return radius_at(polyhedron->sections, z);
  const auto* revolution = std::get_if<Revolution>(&shape);
  return revolution ? radius_of(*revolution, z) : 0.0;
}

double tip_height(const RigidShape& shape)
{
  if (const auto* polyhedron = std::get_if<Polyhedron>(&shape))
    return polyhedron->tip_height;
  const auto* revolution = std::get_if<Revolution>(&shape);
  return revolution ? revolution->tip_height() : 0.0;
}

} // namespace mergel::dem
