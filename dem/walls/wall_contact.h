/// One sphere against one wall: the contact law at a touched point, whatever the wall is
/// made of.
#pragma once

#include "dem/laws/linear.h"
#include "dem/math/exact_sum.h"
#include "dem/pairs/forces.h"
#include "dem/particles/particles.h"

namespace mergel::dem {

/// Where a sphere meets a wall.
struct Touch {
  Vec3 n = Vec3::Zero();     ///< unit, from the centre of the sphere to the wall
  double gap = 0.0;          ///< distance of the sphere's surface to the wall [m]
  Vec3 point = Vec3::Zero(); ///< on the wall [m]
  Vec3 v = Vec3::Zero();     ///< velocity of the wall there [m/s]
};

/// History of one sphere at one smooth wall.
struct WallContact {
  Index particle = 0;
  int wall = 0;            ///< patch of a triangulated wall; 0 for exact surfaces
  Vec3 f_s = Vec3::Zero(); ///< shear force on the particle [N]
  double energy = 0.0;     ///< stored by the contact now [J]
};

/// Add the contact force to the particle and carry the history over the step dt [s].
/// Returns the force on the particle [N]; the wall gets its negative at touch.point. The
/// arm is R + gap, so force and moment balance. r = R, L = R in the law (design: against a
/// wall).
///
/// Sliding moves the touched point without turning the wall, so the history is projected
/// onto the present tangent plane instead of being turned with the pair.
inline Vec3 add_wall_contact(const LinearMaterial& material, const Touch& touch, double dt,
                             Body& body, Load& load, WallContact& history,
                             PairLosses& losses)
{
  const double g_a = material.g_a * body.S;
  if (touch.gap >= g_a && history.f_s.isZero(0.0)) { // apart, and nothing left to lose
    history.energy = 0.0;
    return Vec3::Zero();
  }
  const Vec3 arm = touch.point - body.x;
  const Vec3 v_rel = touch.v - body.v - body.omega.cross(arm);
  const Vec3 du_s = dt * (v_rel - v_rel.dot(touch.n) * touch.n);
  Vec3 f_old = history.f_s - history.f_s.dot(touch.n) * touch.n;
  const double length = f_old.norm(); // kept, so that turning the wall costs no energy
  if (length > 0.0) f_old *= history.f_s.norm() / length;

  const auto k = linear_stiffness(material, body.R, 1.0 / body.R);
  const auto c = linear_contact(material, k, touch.gap, g_a, triple(du_s), triple(f_old));
  if (c.slip_loss != 0.0) losses.slip.add(c.slip_loss);
  history.f_s = vec3(c.f_s);
  history.energy =
      c.f_n > 0.0 ? 0.5 * (c.f_n * c.f_n / k.k_n + history.f_s.squaredNorm() / k.k_s) : 0.0;

  const Vec3 f = history.f_s - c.f_n * touch.n;
  load.f += f;
  load.t += arm.cross(f);
  return f;
}

/// History of `candidates` (ascending in particle, wall), taken over from `old` in the same
/// order.
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
