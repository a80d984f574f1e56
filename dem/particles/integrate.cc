#include "dem/particles/integrate.h"

#include "dem/math/simd.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mergel::dem {

namespace {

Row row(const Vec3& three_of_four) // one row of a record: a vector and a fourth number
{
  Row r;
  std::memcpy(&r, three_of_four.data(), sizeof r);
  return r;
}

void set_row(Vec3& three_of_four, Row r)
{
  std::memcpy(three_of_four.data(), &r, sizeof r);
}

/// Kick of one row, component by component. Returns the new velocity; `damped` gets the
/// work of the damping force. A component without force, such as the fourth of a row, keeps
/// its velocity. There is no branch, because the sign of v cannot be predicted.
Row kicked(Row v, Row f, double alpha, double dt_over_m, double dt, Row& damped)
{
  using Bits = decltype(v < v);
  const Bits sign = reinterpret_cast<Bits>(-Row{}); // -0.0: the sign bit alone
  const Row brake = alpha * reinterpret_cast<Row>(reinterpret_cast<Bits>(f) & ~sign);
  const Bits against = ~reinterpret_cast<Bits>(v) & sign;
  const Row drag =
      reinterpret_cast<Row>((reinterpret_cast<Bits>(brake) | against) & (v != Row{}));
  const Row v_new = v + (f + drag) * dt_over_m;
  damped = drag * 0.5 * (v + v_new) * dt;
  return v_new;
}

/// Kick of one particle, with what is the same for all particles.
struct Kick {
  const Motion& motion;
  Row gravity;
  double dt;
  bool has_weight;

  Kick(const Motion& m, double dt_)
      : motion(m), gravity{m.gravity.x(), m.gravity.y(), m.gravity.z(), 0.0}, dt(dt_),
        has_weight(m.gravity != Vec3::Zero())
  {
  }

  void operator()(Particles& p, Index i, KickWork& work) const
  {
    ParticleState& b = p.state[i];
    const Load& load = p.load[i];
    const double alpha = motion.damping;
    const Vec3 v_old = b.v;
    Row work_of_damping{};
    const double weighs = true_mass(p, i);
    const Row weight = weighs * gravity;
    set_row(b.v,
            kicked(row(b.v), row(load.f) + weight, alpha, dt / b.m, dt, work_of_damping));
    double damped = 0.0 - work_of_damping[0] - work_of_damping[1] - work_of_damping[2];
    const double I_p = inertia(b, motion);
    if (spins(p, motion, i)) {
      set_row(b.omega,
              kicked(row(b.omega), row(load.t), alpha, dt / I_p, dt, work_of_damping));
      damped = damped - work_of_damping[0] - work_of_damping[1] - work_of_damping[2];
    } else if (b.omega != Vec3::Zero()) {
      work.rotation_constraint.add(0.5 * I_p * b.omega.squaredNorm());
      b.omega.setZero();
    }
    work.damping.add(damped);
    if (has_weight) work.gravity.add(0.5 * dt * (weighs * motion.gravity).dot(v_old + b.v));
  }
};

[[noreturn]] void refuse_motion(const Particles& p, Index i, double dt)
{
  const ParticleState& b = p.state[i];
  const std::string remedy = " in one step (at most 0.05): lower `Motion/time step safety`";
  const double moved = dt * b.v.norm() / b.R, rotated = dt * b.omega.norm();
  const std::string who = "particle " + std::to_string(p.id[i]);
  if (!(moved <= 0.05))
    throw NumericalError(who + " moves " + std::to_string(moved) + " radii" + remedy);
  throw NumericalError(who + " turns by " + std::to_string(rotated) + " rad" + remedy);
}

/// Move one particle. Returns the square of its motion over S [m^2].
double drift_one(Particles& p, Index i, double dt)
{
  ParticleState& b = p.state[i];
  const Vec3 dx = dt * b.v;
  const double moved2 = dx.squaredNorm();
  if (!(moved2 <= 0.05 * 0.05 * b.R * b.R) ||
      !(b.omega.squaredNorm() * dt * dt <= 0.05 * 0.05))
    refuse_motion(p, i, dt);
  b.x += dx;
  return moved2 / (b.S * b.S);
}

} // namespace

void kick(Particles& p, const Motion& motion, double dt, KickWork& work)
{
  const Kick kick_one(motion, dt);
  p.for_owned([&](Index i) { kick_one(p, i, work); });
}

void drift(Particles& p, double dt)
{
  p.for_owned([&](Index i) { drift_one(p, i, dt); });
}

double kick_and_drift(Particles& p, const Motion& motion, double dt_kick, double dt,
                      KickWork& work)
{
  const Kick kick_one(motion, dt_kick);
  double max2 = 0.0;
  p.for_owned([&](Index i) {
    kick_one(p, i, work);
    max2 = std::max(max2, drift_one(p, i, dt));
  });
  return std::sqrt(max2);
}

void clear_loads(Particles& p)
{
  for (const IndexRange& r : p.present())
    std::fill(p.load.begin() + r.begin, p.load.begin() + r.end, Load{});
}

EnergySum kinetic_energy_sum(const Particles& p, const Motion& motion)
{
  EnergySum e;
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    e.add(0.5 * (b.m * b.v.squaredNorm() + inertia(b, motion) * b.omega.squaredNorm()));
  });
  return e;
}

ForceSum sum_of_resultants(const Particles& p, const Motion& motion)
{
  ForceSum sum;
  p.for_owned(
      [&](Index i) { sum.add((p.load[i].f + true_mass(p, i) * motion.gravity).norm()); });
  return sum;
}

} // namespace mergel::dem
