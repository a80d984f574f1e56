#include "dem/walls/surfaces.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

Pile::Meeting Pile::meet(const Body& b) const
{
  const double dx = b.x.x() - x_axis, dy = b.x.y() - y_axis;
  const double r = std::hypot(dx, dy), z = b.x.z() - z_tip;
  // Radial unit vector; any direction serves on the axis itself, where the tip is closest.
  const Vec3 e_r = r > 0.0 ? Vec3(dx / r, dy / r, 0.0) : Vec3(1.0, 0.0, 0.0);

  const bool inside = z > 0.0 && (z < cone_height ? r * cone_height < R * z : r < R);
  if (inside)
    throw NumericalError("its centre is inside the pile, at r = " + std::to_string(r) +
                         " m, " + std::to_string(z) +
                         " m above the tip; the pile contact is too soft or "
                         "the time step too long");

  // Foot on the cone, t = 0 at the tip and 1 at the shoulder.
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
  if (!(d > 0.0)) throw NumericalError("a particle centre lies on the surface of the pile");
  Touch touch;
  touch.n = (dr * e_r + dz * Vec3::UnitZ()) / d;
  touch.gap = d - b.R;
  touch.point = b.x + d * touch.n;
  touch.v = Vec3(0.0, 0.0, v_z);
  return {touch, part};
}

VectorSum add_plane_forces(const LinearMaterial& material, const Plane& plane, double dt,
                           Particles& p, SurfaceContacts& contacts, PairLosses& losses)
{
  VectorSum sum;
  for (WallContact& c : contacts.contacts()) {
    Body& body = p.body[c.particle];
    if (plane.is_behind(body))
      throw NumericalError("particle " + std::to_string(p.id[c.particle]) +
                           " passed through a plane wall");
    const Touch touch = plane.touch(body);
    sum.add(-add_wall_contact(material, touch, dt, body, p.load[c.particle], c, losses));
  }
  return sum;
}

PileLoad add_pile_forces(const LinearMaterial& material, const Pile& pile, double dt,
                         Particles& p, SurfaceContacts& contacts, PairLosses& losses)
{
  PileLoad load;
  for (WallContact& c : contacts.contacts()) {
    Body& body = p.body[c.particle];
    const auto [touch, part] =
        naming_particle(p.id[c.particle], [&] { return pile.meet(body); });
    const Vec3 f =
        add_wall_contact(material, touch, dt, body, p.load[c.particle], c, losses);
    (part == Pile::Part::cone ? load.cone : load.shaft).add(-f);
  }
  return load;
}

} // namespace mergel::dem
