/// A few particles and their time step, for the tests of dem/.
#pragma once

#include "dem/assembly/timestep.h"
#include "dem/pairs/pair_sums.h"
#include "dem/particles/integrate.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <random>

namespace mergel::dem::test {

/// The bond of the paper's Table 1, left column.
inline DamageBond bond_of_table_1()
{
  DamageBond b;
  b.E = 400e6;
  b.kappa = 2.0;
  b.sigma_t = 1e6;
  b.sigma_c = 10e6;
  b.C = 1.5e6;
  b.u_c = 0.1e-3;
  b.theta_c = 0.1e-3;
  return b;
}

/// The same bond, too strong to yield.
inline DamageBond unbreakable_bond()
{
  DamageBond b = bond_of_table_1();
  b.sigma_t = b.sigma_c = b.C = 1e15;
  return b;
}

/// Never active: its activation gap lies a metre inside the particles.
inline LinearMaterial no_contact()
{
  LinearMaterial c;
  c.E = 1.0;
  c.g_a = -1.0;
  return c;
}

inline LinearMaterial contact(double E, double kappa, double mu, double g_a)
{
  LinearMaterial c;
  c.E = E;
  c.kappa = kappa;
  c.mu = mu;
  c.g_a = g_a;
  return c;
}

inline ParticleState sphere(const Vec3& x, double R, double rho = 2556.0)
{
  ParticleState b;
  b.x = x;
  b.R = R;
  b.m = sphere_mass(R, rho);
  return b;
}

/// Uniform in the cube [-1, 1]^3.
inline Vec3 random_vector(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

/// Free particles, their pairs and the leapfrog step.
struct Scene {
  Particles p;
  PeriodicCell cell;
  PairMaterials material;
  Bonds bonds;
  Contacts contacts;
  Motion motion;
  PairLosses losses;
  KickWork work;
  /// Adds loads other than those of pairs; its argument is the step that ends now [s].
  std::function<void(double)> add_more = [](double) {};

  /// Particles without friction, bonds, gravity or damping.
  Scene()
  {
    material = {bond_of_table_1(), no_contact()};
    motion.damping = 0.0;
  }

  DamageBond& bond_law() { return std::get<DamageBond>(material.bond); }

  void bond(std::vector<Pair> pairs) { bonds = make_bonds(p, cell, std::move(pairs)); }

  void add_contacts(std::vector<Pair> pairs)
  {
    contacts.pairs = std::move(pairs);
    contacts.shear.assign(contacts.pairs.size(), ContactShear{});
  }

  /// Forces at the present positions, at the end of a step dt [s].
  void forces(double dt)
  {
    clear_loads(p);
    add_bond_forces(material, cell, dt, p, bonds, losses);
    add_contact_forces(material.contact, cell, dt, p, contacts, losses);
    add_more(dt);
  }

  /// From velocities at t = 0 to velocities at dt/2 and positions at dt.
  void start(double dt)
  {
    forces(0.0);
    kick(p, motion, 0.5 * dt, work);
    drift(p, dt);
  }

  void step(double dt)
  {
    forces(dt);
    kick(p, motion, dt, work);
    drift(p, dt);
  }

  /// Moves the first two particles by `dx` [m] and rotates them by `turn` [rad] in a step
  /// dt [s]; returns the work of the motion against the loads, trapezoidal [J].
  double move_pair(const std::array<Vec3, 2>& dx, const std::array<Vec3, 2>& turn,
                   double dt)
  {
    const std::vector<Load> before = p.load;
    for (std::size_t e = 0; e < 2; ++e) {
      p.state[e].v = dx[e] / dt;
      p.state[e].omega = turn[e] / dt;
      p.state[e].x += dx[e];
    }
    forces(dt);
    double work = 0.0;
    for (std::size_t e = 0; e < 2; ++e)
      work -= 0.5 * ((before[e].f + p.load[e].f).dot(dx[e]) +
                     (before[e].t + p.load[e].t).dot(turn[e]));
    return work;
  }

  double stored() const
  {
    const PairSums e = sum_pairs(material, cell, p, bonds, contacts);
    return e.bonds.value() + e.contacts.value();
  }

  Vec3 momentum() const
  {
    Vec3 sum = Vec3::Zero();
    for (const ParticleState& b : p.state) sum += b.m * b.v;
    return sum;
  }

  Vec3 angular_momentum() const
  {
    Vec3 sum = Vec3::Zero();
    for (const ParticleState& b : p.state)
      sum += b.m * b.x.cross(b.v) + b.inertia() * b.omega;
    return sum;
  }
};

/// A scene as an assembly, which finds its contacts by itself. Its lists have a skin of a
/// tenth of the smallest radius.
inline Assembly assembly_of(const Scene& s)
{
  double R = std::numeric_limits<double>::infinity();
  for (const ParticleState& b : s.p.state) R = std::min(R, b.R);
  Assembly a;
  a.particles = s.p;
  a.cell = s.cell;
  a.material = s.material;
  a.bonds = s.bonds;
  a.contacts = s.contacts;
  a.motion = s.motion;
  a.list = VerletList(std::max(0.0, activation_gap(a.material.contact)), 0.1 * R);
  return a;
}

/// Share `safety` of the stable step of a scene [s].
inline double stable_time_step(const Scene& s, double safety)
{
  Assembly a = assembly_of(s);
  return stable_time_step(a, {StepRule::eigenvalue, safety});
}

} // namespace mergel::dem::test
