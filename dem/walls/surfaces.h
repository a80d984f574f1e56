/// Exact walls: plane and cone-ended pile, rigid bodies that the caller moves.
#pragma once

#include "dem/walls/wall_contact.h"

#include <optional>
#include <vector>

namespace mergel::dem {

/// Half space; the particles are on the side to which `normal` points.
struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ(); ///< unit, towards the particles
  Vec3 v = Vec3::Zero();       ///< [m/s]

  ContactGeometry contact_geometry(const ParticleState& b) const
  {
    const double height = (b.x - point).dot(normal);
    return {-normal, height - b.R, b.x - height * normal, v};
  }
  /// True for a centre behind the plane.
  bool is_behind(const ParticleState& b) const { return (b.x - point).dot(normal) < 0.0; }
};

/// Cone-ended pile: exact body of revolution about a vertical axis, moved along it.
///
/// The meridian is the cone from the tip (0, z_tip) to the shoulder (R, z_tip +
/// cone_height) and the shaft above. The profile is convex, so the closest point to a
/// centre outside is unique.
struct Pile {
  double R = 0.0;                    ///< radius of the shaft [m], > 0
  double cone_height = 0.0;          ///< [m], R / tan(half the cone angle), > 0
  double x_axis = 0.0, y_axis = 0.0; ///< [m]
  double z_tip = 0.0;                ///< [m]
  double v_z = 0.0;                  ///< velocity, upwards positive [m/s]

  Vec3 tip() const { return {x_axis, y_axis, z_tip}; }

  enum class Part { cone, shaft };
  struct ClosestPoint {
    ContactGeometry geometry;
    Part part;
  };
  /// The closest point of the pile to the centre. The edge of the shoulder counts as cone.
  /// @throws NumericalError for a centre inside the pile
  ClosestPoint closest_point(const ParticleState& b) const;
  /// Height of the shoulder [m].
  double z_shoulder() const { return z_tip + cone_height; }
};

/// Resultants of the contact forces of one step, on the pile.
struct PileLoad {
  VectorSum cone, shaft; ///< [N]
};

/// Candidates of an exact wall, with the history of each.
class SurfaceContacts {
public:
  /// Find the candidates: particles whose gap to the wall, gap_of(particle state) [m], is
  /// below (g_a + skin) S. They hold until a particle, or the wall, now at `place`, has
  /// moved by half of skin S.
  template <class Gap>
  void rebuild(const Particles& p, double g_a, double skin, const Vec3& place, Gap&& gap_of)
  {
    std::vector<WallContact> near;
    p.for_owned([&](Index i) {
      if (gap_of(p.state[i]) < (g_a + skin) * p.state[i].S)
        near.push_back({i, 0, {0, 0, 0}, 0.0});
    });
    contacts_ = carry_history(std::move(near), contacts_);
    place_ = place;
  }
  /// True when the wall has moved by more than `allowed` [m] since rebuild().
  bool has_moved(const Vec3& place, double allowed) const
  {
    return (place - place_).norm() > allowed;
  }
  std::vector<WallContact>& contacts() { return contacts_; }
  const std::vector<WallContact>& contacts() const { return contacts_; }

  /// Energy stored by the contacts of owned particles [J].
  EnergySum energy() const
  {
    EnergySum e;
    for (const WallContact& c : contacts_) e.add(c.energy);
    return e;
  }

private:
  std::vector<WallContact> contacts_;
  Vec3 place_ = Vec3::Zero();
};

/// Add plane contacts; returns the resultant of owned particles on the plane [N].
/// @throws NumericalError when a centre is behind the plane
VectorSum add_plane_forces(const LinearMaterial& material, const Plane& plane, double dt,
                           Particles& p, SurfaceContacts& contacts, PairLosses& losses);

/// Add pile contacts; returns the resultants of owned particles on the pile [N].
/// @throws NumericalError naming a particle whose centre is inside the pile
PileLoad add_pile_forces(const LinearMaterial& material, const Pile& pile, double dt,
                         Particles& p, SurfaceContacts& contacts, PairLosses& losses);

} // namespace mergel::dem
