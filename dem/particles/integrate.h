/// Leapfrog with local non-viscous damping; velocities belong to half steps
/// (dem/README.md, Motion).
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/particles/particles.h"

#include <concepts>

namespace mergel::dem {

/// Local damping alpha of quasi-static runs [-] (dem/README.md, Motion).
inline constexpr double default_damping = 0.7;

struct Motion {
  Vec3 gravity = Vec3::Zero();      ///< [m/s^2]
  double damping = default_damping; ///< local damping alpha [-], 0 to below 1
  bool free_rotation = false;       ///< lets particles without an intact bond spin
  double inertia_factor = 1.0; ///< of the moments of inertia in the equations of motion [-]
  /// Overlap of two particles over the smaller radius at which a run stops [-].
  double largest_overlap = 0.9;
};

/// Moment of inertia in the equations of motion [kg m^2].
inline double inertia(const ParticleState& b, const Motion& motion)
{
  return motion.inertia_factor * b.inertia();
}

/// Weight and applied force [N].
inline Vec3 dead_load(const Particles& p, const Motion& motion, Index i)
{
  Vec3 f = true_mass(p, i) * motion.gravity;
  if (!p.applied_force.empty()) f += p.applied_force[i];
  return f;
}

/// Whether the particle may spin: the rotation constraint of kick().
inline bool spins(const Particles& p, const Motion& motion, Index i)
{
  return p.n_bonds[i] > 0 || motion.free_rotation;
}

/// Work of the kick on all owned particles. Each term is exact for the leapfrog: force at
/// t^n times the mean of the velocities at n-1/2 and n+1/2.
struct KickWork {
  EnergySum gravity; ///< of weight and applied forces [J]
  EnergySum damping; ///< energy lost to local damping [J]
  EnergySum
      rotation_constraint; ///< spin energy of particles that lost their last bond [J], >= 0
};

/// Show each exact sum to `visit(name, kind, sum)`.
template <class Work, class Visit>
requires std::same_as<std::remove_const_t<Work>, KickWork>
void visit_sums(Work& work, Visit&& visit)
{
  visit("gravity", SumKind::by_rank, work.gravity);
  visit("damping", SumKind::by_rank, work.damping);
  visit("rotation_constraint", SumKind::by_rank, work.rotation_constraint);
}

/// v^{n+1/2} = v^{n-1/2} + dt (f - alpha |f| sign v)/m with f = load + m g + applied force,
/// component by component; the same for the spin. Gravity acts on the true mass. Rotation
/// constraint (paper, section 2.1.2): a particle without an intact bond does not spin.
/// @param dt mean of the steps before and after [s]
void kick(Particles& p, const Motion& motion, double dt, KickWork& work);

/// Kinetic energy of the owned particles after a kick() [J], whose work is added to `work`;
/// the particles stay as they are.
EnergySum kinetic_energy_after_kick(const Particles& p, const Motion& motion, double dt,
                                    KickWork& work);

/// What a particle may move over its radius, or turn [rad], in a step. A grain that is squeezed out
/// of crushed rock flies at some 70 m/s, a twentieth of its radius in a step: that is physics. At a
/// stable step, a motion of R/5 ends a collision with an overlap of at least R/10 after one or two
/// steps, which no longer follow it.
inline constexpr double largest_step_motion = 0.2;

/// x^{n+1} = x^n + dt v^{n+1/2}.
/// @throws NumericalError when a particle moves or turns more than largest_step_motion, or when its
///   motion is not finite
void drift(Particles& p, double dt);

/// kick() over dt_kick and drift() over dt [s] in one pass; leaves the loads at zero.
/// Returns the largest motion over S, less what is spare [m].
/// @param spare part of the motion of each particle that does not count [m]; empty: none
double kick_and_drift(Particles& p, const Motion& motion, double dt_kick, double dt,
                      KickWork& work, const std::vector<double>& spare = {});

/// Set the loads of owned particles and ghosts to zero.
void clear_loads(Particles& p);

/// Kinetic energy of the owned particles at the half step [J].
EnergySum kinetic_energy_sum(const Particles& p, const Motion& motion);
inline double kinetic_energy(const Particles& p, const Motion& motion = {})
{
  return kinetic_energy_sum(p, motion).value();
}

/// Sum of the magnitudes of the resultant forces on owned particles, gravity and applied
/// forces included [N].
ForceSum sum_of_resultants(const Particles& p, const Motion& motion);

} // namespace mergel::dem
