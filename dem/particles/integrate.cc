#include "dem/particles/integrate.h"

#include "dem/math/lane_sum.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace mergel::dem {

namespace {

/// The rows of velocity and spin of a particle, with S and m, which are beside each other; and
/// those of the loads on it.
constexpr std::size_t velocities = offsetof(ParticleState, v);
static_assert(offsetof(ParticleState, omega) == velocities + sizeof(Row));
static_assert(offsetof(Load, t) == sizeof(Row) && sizeof(Load) == sizeof(TwoRows));

TwoRows velocities_of(const ParticleState& b)
{
  TwoRows r;
  std::memcpy(&r, reinterpret_cast<const char*>(&b) + velocities, sizeof r);
  return r;
}

/// Kick of the particles, with what is the same for all of them. It treats velocity and spin
/// together, component by component. A component without load, such as the fourth of a row,
/// keeps its value. There is no branch on signs, because they cannot be predicted.
class Kick {
public:
  Kick(const Particles& p, const Motion& motion, double dt, KickWork& work)
      : p_(p), motion_(motion), dt_(dt),
        has_weight_(motion.gravity != Vec3::Zero() || !p.applied_force.empty()),
        work_(work), damping_(work.damping), gravity_(work.gravity)
  {
  }

  /// @param b the state of particle i
  void operator()(ParticleState& b, Index i)
  {
    TwoRows load;
    std::memcpy(&load, &p_.load[i], sizeof load);
    const double I_p = inertia(b, motion_);
    if (!spins(p_, motion_, i)) {
      const MaskOf<TwoRows> forces_alone{-1, -1, -1, -1, 0, 0, 0, 0};
      load =
          reinterpret_cast<TwoRows>(reinterpret_cast<MaskOf<TwoRows>>(load) & forces_alone);
      stop_spin(b, I_p);
    }
    const TwoRows v = velocities_of(b);
    TwoRows weight{};
    if (has_weight_) {
      const Vec3 w = dead_load(p_, motion_, i);
      weight = TwoRows{w.x(), w.y(), w.z(), 0.0, 0.0, 0.0, 0.0, 0.0};
      load += weight;
    }

    using Bits = MaskOf<TwoRows>;
    const Bits sign = reinterpret_cast<Bits>(-TwoRows{}); // -0.0: the sign bit alone
    const TwoRows brake = motion_.damping * magnitude(load);
    const Bits against = ~reinterpret_cast<Bits>(v) & sign;
    const TwoRows drag = reinterpret_cast<TwoRows>(
        (reinterpret_cast<Bits>(brake) | against) & (v != TwoRows{}));
    const double per_m = dt_ / b.m, per_I = dt_ / I_p;
    const TwoRows dt_over_m{per_m, per_m, per_m, per_m, per_I, per_I, per_I, per_I};
    const TwoRows v_new = v + (load + drag) * dt_over_m;
    const TwoRows mean_motion = 0.5 * dt_ * (v + v_new);
    damping_.add(-drag * mean_motion);
    if (has_weight_) gravity_.add(weight * mean_motion);
    std::memcpy(reinterpret_cast<char*>(&b) + velocities, &v_new, sizeof v_new);
  }

private:
  void stop_spin(ParticleState& b, double I_p)
  {
    if (b.omega == Vec3::Zero()) return;
    work_.rotation_constraint.add(0.5 * I_p * b.omega.squaredNorm());
    b.omega.setZero();
  }

  const Particles& p_;
  const Motion motion_;
  const double dt_;
  const bool has_weight_;
  KickWork& work_;
  LaneEnergySum<TwoRows> damping_, gravity_;
};

double kinetic_energy(const ParticleState& b, const Motion& motion)
{
  return 0.5 * (b.m * b.v.squaredNorm() + inertia(b, motion) * b.omega.squaredNorm());
}

[[noreturn]] void refuse_motion(const Particles& p, Index i, double dt)
{
  const ParticleState& b = p.state[i];
  const std::string remedy = " in one step (at most " + shortest(largest_step_motion) +
                             "): lower `Motion/time step safety`";
  const double moved = dt * b.v.norm() / b.R, rotated = dt * b.omega.norm();
  const std::string who = "particle " + std::to_string(p.id[i]);
  if (!(moved <= largest_step_motion))
    throw NumericalError(who + " moves " + std::to_string(moved) + " radii" + remedy);
  throw NumericalError(who + " turns by " + std::to_string(rotated) + " rad" + remedy);
}

/// Moves the particles and keeps their largest motion over S, less what is spare.
class Drift {
public:
  Drift(Particles& p, double dt, const std::vector<double>& spare)
      : p_(p), dt_(dt), spare_(spare.empty() ? nullptr : spare.data())
  {
  }

  void operator()(Index i)
  {
    ParticleState& b = p_.state[i];
    const Vec3 dx = dt_ * b.v;
    const double moved2 = dx.squaredNorm();
    constexpr double most2 = largest_step_motion * largest_step_motion;
    if (!(moved2 <= most2 * b.R * b.R) || !(b.omega.squaredNorm() * dt_ * dt_ <= most2))
      refuse_motion(p_, i, dt_);
    b.x += dx;
    const double spare = spare_ ? spare_[i] : 0.0;
    const double most = largest_ * b.S + spare;
    if (moved2 > most * most) largest_ = (std::sqrt(moved2) - spare) / b.S; // seldom
  }

  double largest() const { return largest_; } ///< [m]

private:
  Particles& p_;
  const double dt_;
  const double* const spare_;
  double largest_ = 0.0;
};

} // namespace

void kick(Particles& p, const Motion& motion, double dt, KickWork& work)
{
  Kick kick_one(p, motion, dt, work);
  p.for_owned([&](Index i) { kick_one(p.state[i], i); });
}

EnergySum kinetic_energy_after_kick(const Particles& p, const Motion& motion, double dt,
                                    KickWork& work)
{
  Kick kick_one(p, motion, dt, work);
  EnergySum e;
  p.for_owned([&](Index i) {
    ParticleState b = p.state[i];
    kick_one(b, i);
    e.add(kinetic_energy(b, motion));
  });
  return e;
}

void drift(Particles& p, double dt)
{
  Drift drift_one(p, dt, {});
  p.for_owned([&](Index i) { drift_one(i); });
}

double kick_and_drift(Particles& p, const Motion& motion, double dt_kick, double dt,
                      KickWork& work, const std::vector<double>& spare)
{
  Kick kick_one(p, motion, dt_kick, work);
  Drift drift_one(p, dt, spare);
  p.for_owned([&](Index i) {
    kick_one(p.state[i], i);
    p.load[i] = Load{};
    drift_one(i);
  });
  return drift_one.largest();
}

void clear_loads(Particles& p)
{
  for (const IndexRange& r : p.present())
    std::fill(p.load.begin() + r.begin, p.load.begin() + r.end, Load{});
}

EnergySum kinetic_energy_sum(const Particles& p, const Motion& motion)
{
  EnergySum e;
  p.for_owned([&](Index i) { e.add(kinetic_energy(p.state[i], motion)); });
  return e;
}

ForceSum sum_of_resultants(const Particles& p, const Motion& motion)
{
  ForceSum sum;
  p.for_owned([&](Index i) { sum.add((p.load[i].f + dead_load(p, motion, i)).norm()); });
  return sum;
}

} // namespace mergel::dem
