#include "dem/integrate.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

/// One component: returns the new velocity, adds what damping took. The sign of v is as
/// good as random: no branch.
double kicked(double v, double f, double alpha, double dt_over_m, double dt, double& damped)
{
  const double drag = -std::copysign(v != 0.0 ? alpha * std::abs(f) : 0.0, v);
  const double v_new = v + (f + drag) * dt_over_m;
  damped -= drag * 0.5 * (v + v_new) * dt;
  return v_new;
}

} // namespace

void kick(Particles& p, const Motion& motion, double dt, KickWork& work)
{
  const double alpha = motion.damping;
  p.for_owned([&](Index i) {
    Body& b = p.body[i];
    const Load& load = p.load[i];
    const Vec3 weight = b.m * motion.gravity;
    const double dt_over_m = dt / b.m;
    double damped = 0.0;
    const Vec3 v_old = b.v;
    for (int a = 0; a < 3; ++a)
      b.v[a] = kicked(b.v[a], load.f[a] + weight[a], alpha, dt_over_m, dt, damped);
    if (p.n_bonds[i] > 0 || motion.free_rotation) {
      const double dt_over_I = dt / b.inertia();
      for (int a = 0; a < 3; ++a)
        b.omega[a] = kicked(b.omega[a], load.t[a], alpha, dt_over_I, dt, damped);
    } else if (b.omega != Vec3::Zero()) {
      work.lock.add(0.5 * b.inertia() * b.omega.squaredNorm());
      b.omega.setZero();
    }
    work.damping.add(damped);
    work.gravity.add(0.5 * dt * weight.dot(v_old + b.v));
  });
}

void drift(Particles& p, double dt)
{
  p.for_owned([&](Index i) {
    Body& b = p.body[i];
    const Vec3 dx = dt * b.v;
    const double limit = b.R / 20.0;
    if (!(dx.squaredNorm() <= limit * limit))
      throw NumericalError(
          "particle " + std::to_string(p.id[i]) + " moves " +
          std::to_string(dx.norm() / b.R) +
          " radii in one step (at most 0.05): lower `Motion/time step safety`");
    if (!(b.omega.squaredNorm() * dt * dt <= 0.05 * 0.05))
      throw NumericalError(
          "particle " + std::to_string(p.id[i]) + " turns by " +
          std::to_string(b.omega.norm() * dt) +
          " rad in one step (at most 0.05): lower `Motion/time step safety`");
    b.x += dx;
  });
}

void clear_loads(Particles& p)
{
  for (const IndexRange& r : p.present())
    std::fill(p.load.begin() + r.begin, p.load.begin() + r.end, Load{});
}

EnergySum kinetic_energy_sum(const Particles& p)
{
  EnergySum e;
  p.for_owned([&](Index i) {
    const Body& b = p.body[i];
    e.add(0.5 * (b.m * b.v.squaredNorm() + b.inertia() * b.omega.squaredNorm()));
  });
  return e;
}

ForceSum sum_of_resultants(const Particles& p, const Motion& motion)
{
  ForceSum sum;
  p.for_owned(
      [&](Index i) { sum.add((p.load[i].f + p.body[i].m * motion.gravity).norm()); });
  return sum;
}

} // namespace mergel::dem
