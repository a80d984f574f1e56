/// A rigid wall: one of several shapes, moved by the caller as a whole (dem/README.md,
/// Walls).
///
/// To add a shape: a header beside plane.h that meets IsRigidShape, its name in RigidShape,
/// its keys in the job that makes it, and a test. Nothing else knows the shapes.
#pragma once

#include "dem/walls/plane.h"
#include "dem/walls/polyhedron.h"
#include "dem/walls/revolution.h"

#include <Eigen/Geometry>

#include <concepts>
#include <variant>
#include <vector>

namespace mergel::dem {

/// A shape has named parts, whose resultants are kept apart, and a closest point to a
/// particle when the wall stands upright at x [m]. A quick test may tell that the gap is
/// larger than `gap`; it may fail to.
// clang-format off
template <class Shape>
concept IsRigidShape =
    requires(const Shape& shape, const ParticleState& b, const Vec3& x, double gap)
{
  { Shape::parts.size() } -> std::convertible_to<std::size_t>;
  { Shape::parts.front() } -> std::convertible_to<const char*>;
  { shape.closest_point(b, x) } -> std::same_as<SurfacePoint>;
  { shape.is_beyond(b, x, gap) } -> std::same_as<bool>;
};
// clang-format on

using RigidShape = std::variant<Plane, Revolution, Polyhedron>;
static_assert(IsRigidShape<Plane> && IsRigidShape<Revolution> && IsRigidShape<Polyhedron>);

/// The caller sets position, rotation and both velocities.
struct RigidWall {
  RigidShape shape;
  Vec3 x = Vec3::Zero(); ///< position: the origin of the shape [m]
  Vec3 v = Vec3::Zero(); ///< velocity of the origin [m/s]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity(); ///< about the origin
  Vec3 omega = Vec3::Zero();                                    ///< spin [rad/s]
  double reach = 0.0; ///< of a wall that rotates: no particle that it touches is farther
                      ///< from its origin [m]
  ContactLaw material;
  std::vector<WallContact> contacts; ///< candidates, ascending in particle
  Vec3 x_listed = Vec3::Zero();      ///< x when the candidates were found [m]
  Eigen::Quaterniond rotation_listed = Eigen::Quaterniond::Identity(); ///< rotation then
  std::vector<VectorSum> force;  ///< on each part in the last step, of all ranks [N]
  ExactVector<MomentSum> moment; ///< of these about the origin, of all ranks [N m]
  EnergySum work; ///< on the particles by the motion of the wall, of all ranks [J]

  Vec3 resultant() const; ///< of the forces on all parts [N]
  bool is_rotated() const { return rotation.vec() != Vec3::Zero(); }
  Vec3 seen(const Vec3& point) const { return rotation.conjugate() * (point - x); }
  Vec3 placed(const Vec3& seen) const ///< where a point in the axes of the shape stands [m]
  {
    return x + rotation * seen;
  }
  Vec3 velocity_at(const Vec3& point) const ///< of a point that moves with it [m/s]
  {
    if (omega == Vec3::Zero()) return v;
    return v + omega.cross(point - x);
  }
};

RigidWall make_rigid_wall(RigidShape shape, const Vec3& x, const ContactLaw& material);

/// The point of the wall that is closest to the centre of the particle.
/// @throws NumericalError for a centre inside the wall
SurfacePoint closest_point(const RigidWall& wall, const ParticleState& b);

/// Finds the features of a polyhedron that a particle of its wall touches.
class FeaturesOfWall {
public:
  /// @pre the shape of the wall is a triangulated polyhedron; @param wall must outlive the object
  explicit FeaturesOfWall(const RigidWall& wall)
      : wall_(wall), features_(std::get<Polyhedron>(wall.shape))
  {
  }
  /// Of all that lie within `reach` [m] of a centre x, where they stand.
  /// @throws NumericalError for a centre inside the wall
  const std::vector<PatchFeature>& find(const Vec3& x, double reach);

private:
  const RigidWall& wall_;
  PolyhedronFeatures features_;
  std::vector<PatchFeature> found_;
};

/// Find the candidates: particles whose gap to the wall is below (g_a + skin) S plus their
/// extra reach (VerletList). They hold until a particle or the wall has moved by half of
/// skin S.
/// @throws NumericalError naming a particle whose centre is inside the wall
void rebuild_wall(RigidWall& wall, const PairMaterials& material, const Particles& p,
                  double skin, const std::vector<double>& extra = {});

/// Largest motion of a point within reach since the candidates were found [m].
double travel(const RigidWall& wall);

/// Add the contact forces to p.load and set wall.force over the step dt [s] that ends now.
/// @throws NumericalError naming a particle whose centre is inside the wall
void add_wall_forces(RigidWall& wall, const PairMaterials& material, double dt,
                     Particles& p, PairLosses& losses);

/// Stored by the contacts of owned particles [J].
EnergySum stored_energy(const RigidWall& wall, const Particles& p);

/// Power on the particles at the present velocity, from the forces of the last step [W].
double power(const RigidWall& wall);

/// The records that belong to a particle and migrate with it.
inline auto histories(RigidWall& wall)
{
  return std::tie(wall.contacts);
}

/// Show each exact sum, with its name, to `visit(name, kind, sum)`.
template <class Wall, class Visit>
requires std::same_as<std::remove_const_t<Wall>, RigidWall>
void visit_sums(Wall& wall, Visit&& visit)
{
  visit("force", SumKind::forces, wall.force);
  visit("moment", SumKind::forces, wall.moment);
  visit("work", SumKind::total, wall.work);
}

} // namespace mergel::dem
