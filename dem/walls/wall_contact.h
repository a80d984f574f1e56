/// Contact law between a particle and a point of a wall of any shape (dem/README.md,
/// Walls).
#pragma once

#include "dem/laws/contact_law.h"
#include "dem/math/exact_sum.h"
#include "dem/pairs/forces.h"
#include "dem/particles/kinematics.h"
#include "dem/particles/particles.h"

#include <cmath>

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
  /// [m]; 0 when open. Of several features of a patch, the one that has their energy; negative
  /// with the energy.
  double overlap = 0.0;
};

/// The same as ContactGeometry, for one contact or one per lane.
template <class Real>
struct WallPoint {
  Triple<Real> n;
  Real gap;
  Triple<Real> x, v;
};

inline End<double> end_of(const ParticleState& b)
{
  return {triple(b.x), b.R, triple(b.v), b.S, triple(b.omega)};
}
inline WallPoint<double> wall_point(const ContactGeometry& at)
{
  return {triple(at.n), at.gap, triple(at.point), triple(at.v)};
}

/// Result of one step of a wall contact.
template <class Real>
struct WallContactStep {
  Triple<Real> F, M; ///< force and moment on the particle [N], [N m]; -F acts at the point
  Triple<Real> f_s;  ///< the new history [N]
  Real slip_loss;    ///< [J]
};

/// How the wall moves against a particle over dt [s].
///
/// A particle that slides along a curved wall does not rotate the wall. So the history f_s is
/// not rotated with the contact frame: it is projected onto the present tangent plane and
/// keeps its length (dem/README.md, History vectors).
template <class Real>
[[gnu::always_inline]] inline ContactMotion<Real>
motion_at_wall(const End<Real>& particle, const WallPoint<Real>& at,
               const Triple<Real>& f_s, double dt)
{
  const Triple<Real> arm = at.x - particle.x;
  const Triple<Real> v_rel = at.v - particle.v - cross(particle.omega, arm);
  const Real v_n = dot(v_rel, at.n);
  const Triple<Real> du_s = (v_rel - at.n * v_n) * dt;
  const Triple<Real> tangential = f_s - at.n * dot(f_s, at.n);
  const Real length2 = dot(tangential, tangential), one = Real{} + 1.0;
  const auto has_length = length2 > Real{};
  const Real stretch = sqrt(dot(f_s, f_s) / select(has_length, length2, one));
  return {at.gap, v_n * dt, du_s, tangential * select(has_length, stretch, one)};
}

/// One step of a contact that is closed, over dt [s]. The arm is R + gap, so forces and
/// moments balance. In the contact law r = R and L = R.
template <IsContactLaw Law, class Real>
[[gnu::always_inline]] inline WallContactStep<Real>
wall_contact_step(const Law& law, const End<Real>& particle, const WallPoint<Real>& at,
                  const Triple<Real>& f_s, double dt)
{
  const ContactStep<Real> c = contact_step(law, sides_at_wall(particle.R), particle.S,
                                           motion_at_wall(particle, at, f_s, dt));
  const Triple<Real> F = c.f_s - at.n * c.f_n;
  return {F, cross(at.x - particle.x, F), c.f_s, c.slip_loss};
}

/// The contact opens, or is open: it loses the energy of its shear force.
template <IsContactLaw Law>
void open_contact(const Law& law, double R, WallContact& contact, PairLosses& losses)
{
  if (contact.f_s != Vec3::Zero())
    losses.slip.add(0.5 * contact.f_s.squaredNorm() /
                    contact_stiffness(law, sides_at_wall(R), contact.overlap).k_s);
  contact.f_s.setZero();
  contact.overlap = 0.0;
}

/// Add the contact force to the particle and update the history over the step dt [s].
/// Returns the force on the particle [N]; its negative acts on the wall at geometry.point.
template <IsContactLaw Law>
Vec3 add_wall_contact(const Law& law, const ContactGeometry& geometry, double dt,
                      const ParticleState& particle, Load& load, WallContact& history,
                      PairLosses& losses)
{
  const double overlap = activation_gap(law) * particle.S - geometry.gap;
  if (overlap <= 0.0) { // one that is not a number is found by the exact sums
    open_contact(law, particle.R, history, losses);
    return Vec3::Zero();
  }
  history.overlap = overlap;
  const WallContactStep<double> step = wall_contact_step(
      law, end_of(particle), wall_point(geometry), triple(history.f_s), dt);
  if (step.slip_loss != 0.0) losses.slip.add(step.slip_loss);
  history.f_s = vec3(step.f_s);
  load.f += vec3(step.F);
  load.t += vec3(step.M);
  return vec3(step.F);
}

/// Stored by these contacts [J].
inline EnergySum stored_energy(const std::vector<WallContact>& contacts,
                               const ContactLaw& law, const Particles& p)
{
  EnergySum e;
  for (const WallContact& c : contacts) {
    if (c.overlap == 0.0) continue;
    const double size = contact_energy(law, sides_at_wall(p.state[c.particle].R),
                                       std::abs(c.overlap), c.f_s.squaredNorm());
    e.add(c.overlap > 0.0 ? size : -size); // without shear force where it is negative
  }
  return e;
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
