/// The branches of an assembly: lines from centre to centre along which bonds and contacts
/// transmit forces.
#pragma once

#include "dem/assembly/assembly.h"

#include <algorithm>

namespace mergel::dem {

/// Geometry of a pair at the present positions.
struct Branch {
  Vec3 r; ///< from i to j [m]
  double L, radius, S;

  Branch(const Assembly& assembly, const Pair& q)
  {
    const ParticleState &i = assembly.particles.state[q.i],
                        &j = assembly.particles.state[q.j];
    r = j.x + assembly.cell.offset(q.shift) - i.x;
    L = i.R + j.R;
    radius = std::min(i.R, j.R);
    S = 0.5 * (i.S + j.S);
  }
  Vec3 n() const { return r.normalized(); }
};

/// Show the force F on the first particle [N] of each intact bond and loaded contact of the pairs
/// that are wanted(q) to `visit(q, branch, F)`: bonds in their order, each with the contact of its
/// pair after it, then the other contacts.
template <class Wanted, class Visit>
void visit_branches(const Assembly& assembly, Wanted&& wanted, Visit&& visit)
{
  const Particles& p = assembly.particles;
  const auto visit_contact = [&](const Pair& q, const Vec3& f_s) {
    const double f_n =
        read_contact(q, f_s, p, assembly.cell, assembly.material.contact).f_n;
    if (f_n == 0.0) return;
    const Branch b(assembly, q);
    visit(q, b, Vec3(f_s - f_n * b.n()));
  };
  for (std::size_t k = 0; k < assembly.bonds.size(); ++k) {
    const Pair& q = assembly.bonds.pairs[k];
    if (!wanted(q)) continue;
    if (assembly.bonds.intact(k) > 0.0) {
      const Branch b(assembly, q);
      const BondReading bond =
          read_bond(assembly.bonds, k, p, assembly.cell, assembly.material.bond);
      visit(q, b, Vec3(bond.N * b.n() + bond.V));
    }
    visit_contact(q, contact_shear_of(assembly.bonds, k));
  }
  for (std::size_t c = 0; c < assembly.contacts.pairs.size(); ++c)
    if (wanted(assembly.contacts.pairs[c]))
      visit_contact(assembly.contacts.pairs[c], assembly.contacts.shear[c].f_s);
}

/// The pairs whose first particle this rank owns: each pair on one rank.
template <class Visit>
void visit_branches(const Assembly& assembly, Visit&& visit)
{
  visit_branches(
      assembly, [&](const Pair& q) { return assembly.particles.owns(q.i); }, visit);
}

} // namespace mergel::dem
