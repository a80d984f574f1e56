/// Contact law between a particle and a point of a wall of any shape (dem/README.md,
/// Walls).
#pragma once

#include "dem/laws/contact_law.h"
#include "dem/math/exact_sum.h"
#include "dem/pairs/forces.h"
#include "dem/particles/particles.h"

namespace mergel::dem {

/// The point of a rigid body that is closest to the centre of a particle.
struct SurfacePoint {
  Vec3 n = Vec3::Zero();     ///< unit, from the centre of the particle to the wall
  double gap = 0.0;          ///< distance of the particle's surface to the wall [m]
  Vec3 point = Vec3::Zero(); ///< [m]
  std::size_t part = 0;      ///< part of the wall, an index of its shape's `parts`
};

/// Position of a wall relative to a particle, at the closest point of the wall.
struct ContactGeometry {
  Vec3 n = Vec3::Zero();     ///< unit, from the centre of the particle to the wall
  double gap = 0.0;          ///< distance of the particle's surface to the wall [m]
  Vec3 point = Vec3::Zero(); ///< closest point of the wall [m]
  Vec3 v = Vec3::Zero();     ///< velocity of the wall there [m/s]
};

/// History of one particle at one smooth wall.
struct WallContact {
  Index particle = 0;
  int wall = 0;            ///< patch of a triangulated wall; 0 for exact surfaces
  Vec3 f_s = Vec3::Zero(); ///< shear force on the particle [N]
  double energy = 0.0;     ///< stored by the contact [J]
  double overlap = 0.0;    ///< [m]; 0 when open
};

/// Add the contact force to the particle and update the history over the step dt [s].
/// Returns the force on the particle [N]; its negative acts on the wall at geometry.point.
/// The arm is R + gap, so forces and moments balance. In the contact law r = R and L = R.
///
/// A particle that slides along a curved wall does not rotate the wall. So the history is
/// not rotated with the contact frame: it is projected onto the present tangent plane and
/// keeps its length (dem/README.md, History vectors).
template <IsContactLaw Law>
Vec3 add_wall_contact(const Law& law, const ContactGeometry& geometry, double dt,
                      ParticleState& particle, Load& load, WallContact& history,
                      PairLosses& losses)
{
  const double overlap = activation_gap(law) * particle.S - geometry.gap;
  history.overlap = std::max(0.0, overlap);
  if (overlap <= 0.0 && history.f_s.isZero(0.0)) { // open, and no shear force
    history.energy = 0.0;
    return Vec3::Zero();
  }
  const Vec3 arm = geometry.point - particle.x;
  const Vec3 v_rel = geometry.v - particle.v - particle.omega.cross(arm);
  const double v_n = v_rel.dot(geometry.n);
  const Vec3 du_s = dt * (v_rel - v_n * geometry.n);
  Vec3 f_old = history.f_s - history.f_s.dot(geometry.n) * geometry.n;
  const double length = f_old.norm(); // the length is kept, so projection loses no energy
  if (length > 0.0) f_old *= history.f_s.norm() / length;

  const ContactSides<double> sides = sides_at_wall(particle.R);
  const ContactStep<double> c = contact_step(
      law, sides, particle.S, {geometry.gap, dt * v_n, triple(du_s), triple(f_old)});
  if (c.slip_loss != 0.0) losses.slip.add(c.slip_loss);
  history.f_s = vec3(c.f_s);
  history.energy =
      c.f_n > 0.0 ? contact_energy_of_force(law, sides, c.f_n, history.f_s.squaredNorm())
                  : 0.0;

  const Vec3 f = history.f_s - c.f_n * geometry.n;
  load.f += f;
  load.t += arm.cross(f);
  return f;
}

/// The candidates with their histories from `old`; both ascend in (particle, wall).
inline std::vector<WallContact> carry_history(std::vector<WallContact> candidates,
                                              const std::vector<WallContact>& old)
{
  std::size_t o = 0;
  const auto key = [](const WallContact& c) { return std::pair{c.particle, c.wall}; };
  for (WallContact& c : candidates) {
    while (o < old.size() && key(old[o]) < key(c)) ++o;
    if (o < old.size() && key(old[o]) == key(c)) c = old[o];
  }
  return candidates;
}

} // namespace mergel::dem
