#include "dem/walls/surfaces.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

Pile::ClosestPoint Pile::closest_point(const ParticleState& b) const
{
  const double dx = b.x.x() - x_axis, dy = b.x.y() - y_axis;
  const double r = std::hypot(dx, dy), z = b.x.z() - z_tip;
  // Radial unit vector; on the axis any direction does, because the tip is closest there.
  const Vec3 e_r = r > 0.0 ? Vec3(dx / r, dy / r, 0.0) : Vec3(1.0, 0.0, 0.0);

  const bool inside = z > 0.0 && (z < cone_height ? r * cone_height < R * z : r < R);
  if (inside)
    throw NumericalError("its centre is inside the pile, at r = " + std::to_string(r) +
                         " m, " + std::to_string(z) +
                         " m above the tip; the pile contact is too soft or "
                         "the time step too long");

  // Closest point of the line of the cone: t = 0 at the tip and 1 at the shoulder.
  const double length2 = R * R + cone_height * cone_height;
  const double t = (r * R + z * cone_height) / length2;
  double r_foot, z_foot;
  Part part = Part::cone;
  if (t <= 1.0) {
    r_foot = std::max(0.0, t) * R;
    z_foot = std::max(0.0, t) * cone_height;
  } else {
    r_foot = R;
    z_foot = std::max(cone_height, z);
    if (z > cone_height) part = Part::shaft;
  }
  const double dr = r_foot - r, dz = z_foot - z, d = std::hypot(dr, dz);
  if (!(d > 0.0)) throw NumericalError("its centre lies on the surface of the pile");
  ContactGeometry geometry;
  geometry.n = (dr * e_r + dz * Vec3::UnitZ()) / d;
  geometry.gap = d - b.R;
  geometry.point = b.x + d * geometry.n;
  geometry.v = Vec3(0.0, 0.0, v_z);
  return {geometry, part};
}

VectorSum add_plane_forces(const LinearMaterial& material, const Plane& plane, double dt,
                           Particles& p, SurfaceContacts& contacts, PairLosses& losses)
{
  VectorSum sum;
  for (WallContact& c : contacts.contacts()) {
    ParticleState& particle = p.state[c.particle];
    if (plane.is_behind(particle))
      throw NumericalError("particle " + std::to_string(p.id[c.particle]) +
                           " passed through a plane wall");
    const ContactGeometry geometry = plane.contact_geometry(particle);
    sum.add(
        -add_wall_contact(material, geometry, dt, particle, p.load[c.particle], c, losses));
  }
  return sum;
}

PileLoad add_pile_forces(const LinearMaterial& material, const Pile& pile, double dt,
                         Particles& p, SurfaceContacts& contacts, PairLosses& losses)
{
  PileLoad load;
  for (WallContact& c : contacts.contacts()) {
    ParticleState& particle = p.state[c.particle];
    const auto [geometry, part] =
        with_particle_id(p.id[c.particle], [&] { return pile.closest_point(particle); });
    const Vec3 f =
        add_wall_contact(material, geometry, dt, particle, p.load[c.particle], c, losses);
    (part == Pile::Part::cone ? load.cone : load.shaft).add(-f);
  }
  return load;
}

} // namespace mergel::dem
