#include "dem/assembly/timestep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

/// A twisting stiffness k_s R_b^2/2 is left out: it is below k_s arm^2 about another axis.
void add_spring(StiffnessSums& s, Index i, double k_n, double k_s, double arm, double k_b)
{
  s.k[i] += k_n;
  s.k_rot[i] += 2.0 * (k_s * arm * arm + k_b);
}

/// Add the stiffness of bond and contact of one pair to both particles.
void add_pair(StiffnessSums& s, const PairMaterials& material, const PeriodicCell& cell,
              const Particles& p, const Pair& q, bool bonded)
{
  const ParticleState &i = p.state[q.i], &j = p.state[q.j];
  const double L = i.R + j.R, r = std::min(i.R, j.R);
  const double gap = (j.x + cell.offset(q.shift) - i.x).norm() - L;
  double k_n = 0.0, k_s = 0.0, k_b = 0.0;
  if (bonded) {
    const auto b = bond_shape(section(material.bond), r, 1.0 / L);
    k_n += b.k_n;
    k_s += b.k_s;
    k_b += b.k_b;
  }
  const double g_a = activation_gap(material.contact) * 0.5 * (i.S + j.S);
  if (gap < g_a) {
    const auto c =
        contact_stiffness(material.contact, sides_of_pair(i.R, j.R, 1.0 / L), g_a - gap);
    k_n += c.k_n;
    k_s += c.k_s;
  }
  if (k_n == 0.0) return;
  add_spring(s, q.i, k_n, k_s, i.R + 0.5 * gap, k_b);
  add_spring(s, q.j, k_n, k_s, j.R + 0.5 * gap, k_b);
}

} // namespace

StiffnessSums stiffness_sums(const PairMaterials& material, const PeriodicCell& cell,
                             const Particles& p, const Bonds& bonds,
                             const Contacts& contacts)
{
  StiffnessSums s{std::vector<double>(p.size()), std::vector<double>(p.size())};
  for (std::size_t b = 0; b < bonds.size(); ++b)
    add_pair(s, material, cell, p, bonds.pairs[b], bonds.intact(b) > 0.0);
  for (const Pair& q : contacts.pairs) add_pair(s, material, cell, p, q, false);
  return s;
}

namespace {

void add_contacts(StiffnessSums& s, const ContactLaw& law,
                  const std::vector<WallContact>& contacts, const Particles& p)
{
  for (const WallContact& c : contacts) {
    if (c.energy == 0.0) continue;
    const double R = p.state[c.particle].R;
    const auto k = contact_stiffness(law, sides_at_wall(R), c.overlap);
    add_spring(s, c.particle, k.k_n, k.k_s, R, 0.0);
  }
}

} // namespace

void add_wall_stiffness(StiffnessSums& s, const Wall& wall, const PairMaterials& material,
                        const Particles& p)
{
  add_contacts(s, wall.material, wall.contacts, p);
  for (const WallBond& b : wall.bonds) {
    if (b.state.intact == 0.0) continue;
    const double R = p.state[b.particle].R;
    const auto k = bond_shape(section(material.bond), R, 1.0 / R);
    add_spring(s, b.particle, k.k_n, k.k_s, R + std::max(0.0, b.gap_0), 0.0);
  }
}

void add_wall_stiffness(StiffnessSums& s, const RigidWall& wall, const PairMaterials&,
                        const Particles& p)
{
  add_contacts(s, wall.material, wall.contacts, p);
}

void add_wall_stiffness(StiffnessSums& s, const Mirror& mirror,
                        const PairMaterials& material, const Particles& p)
{
  for (const MirrorPair& m : mirror.pairs) {
    const ParticleState& b = p.state[m.particle];
    const double gap = 2.0 * (b.x.y() - b.R);
    // A particle and its image are a pair of equal masses.
    if (m.bond.intact > 0.0)
      s.k[m.particle] += bond_shape(section(material.bond), b.R, 0.5 / b.R).k_n;
    const double overlap = activation_gap(material.contact) * b.S - gap;
    if (overlap > 0.0)
      s.k[m.particle] +=
          contact_stiffness(material.contact, sides_at_mirror(b.R), overlap).k_n;
  }
}

double time_step(const StiffnessSums& s, const Particles& p, double safety,
                 const Motion& motion)
{
  double dt2 = std::numeric_limits<double>::infinity();
  p.for_owned([&](Index i) {
    if (s.k[i] > 0.0) dt2 = std::min(dt2, 2.0 * p.state[i].m / s.k[i]);
    if (s.k_rot[i] > 0.0 && (p.n_bonds[i] > 0 || motion.free_rotation))
      dt2 = std::min(dt2, 2.0 * p.state[i].inertia() / s.k_rot[i]);
  });
  return safety * std::sqrt(dt2 / (1.0 + motion.damping));
}

ForceSum sum_of_pair_forces(const Particles& p, const PairMaterials& material,
                            const PeriodicCell& cell, const Bonds& bonds,
                            const Contacts& contacts)
{
  // Each pair force acts on two particles; the owner of the first particle counts it.
  ForceSum sum;
  const auto contact_force = [&](const Pair& q) {
    return read_contact(q, Vec3::Zero(), p, cell, material.contact).f_n;
  };
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (!p.owns(bonds.pairs[b].i)) continue;
    const BondReading r = read_bond(bonds, b, p, cell, material.bond);
    sum.add(2.0 * (std::hypot(r.N, r.V.norm()) + contact_force(bonds.pairs[b])));
  }
  for (const Pair& q : contacts.pairs)
    if (p.owns(q.i)) sum.add(2.0 * contact_force(q));
  return sum;
}

} // namespace mergel::dem
