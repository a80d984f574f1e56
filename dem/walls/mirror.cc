#include "dem/walls/mirror.h"

#include "dem/pairs/strength.h"

#include <stdexcept>

namespace mergel::dem {

namespace {

double image_gap(const ParticleState& b)
{
  return 2.0 * (b.x.y() - b.R);
}

} // namespace

namespace {

/// Candidates with a gap below `reach` S [m].
void list_pairs(Mirror& mirror, const Particles& p, double reach,
                const std::vector<double>& extra)
{
  std::vector<MirrorPair> pairs;
  auto old = mirror.pairs.begin();
  p.for_owned([&](Index i) {
    while (old != mirror.pairs.end() && old->particle < i) ++old;
    const bool known = old != mirror.pairs.end() && old->particle == i;
    const double flight = extra.empty() ? 0.0 : 2.0 * extra[i]; // of particle and image
    const bool near = image_gap(p.state[i]) < reach * p.state[i].S + flight;
    if (known && (near || old->bond.intact > 0.0))
      pairs.push_back(*old);
    else if (near)
      pairs.push_back({i, 0.0, {0.0, 0.0}});
  });
  mirror.pairs = std::move(pairs);
}

} // namespace

void rebuild_wall(Mirror& mirror, const PairMaterials& material, const Particles& p,
                  double skin, const std::vector<double>& extra)
{
  list_pairs(mirror, p, activation_gap(material.contact) + 2.0 * skin, extra);
}

void bond_to_mirror(Mirror& mirror, Particles& p, double limit)
{
  if (!mirror.pairs.empty()) throw std::logic_error("this mirror is bonded already");
  list_pairs(mirror, p, limit, {});
  for (MirrorPair& m : mirror.pairs) {
    ParticleState& b = p.state[m.particle];
    m.gap_0 = image_gap(b);
    m.bond = {0.0, 1.0};
    ++p.n_bonds[m.particle];
    b.omega = {0.0, b.omega.y(), 0.0};
  }
}

namespace {

EffectiveLoads<double> image_bond_load(const BondShape<double>& shape, const MirrorPair& m,
                                       double gap)
{
  return {shape.k_n * (gap - m.gap_0 - m.bond.u_p), {}, {}};
}

/// Force of an intact bond, towards the image [N]. Only half of its losses is counted: the
/// other half belongs to the image.
template <IsBondLaw Law>
double image_bond_force(const Law& law, double dt, double gap, Particles& p, MirrorPair& m,
                        PairLosses& losses)
{
  const ParticleState& b = p.state[m.particle];
  const auto shape = bond_shape(law, b.R, 0.5 / b.R);
  EffectiveLoads<double> q = image_bond_load(shape, m, gap);
  if (!is_elastic(law, shape, q)) {
    EffectiveLoads<double> old = q;
    old.N -= shape.k_n * 2.0 * dt * b.v.y();
    if (bond_step(law, shape, b.S, old, q, m.bond, &losses, 0.5).breaks)
      --p.n_bonds[m.particle];
  }
  return m.bond.intact * q.N;
}

template <IsBondLaw Law, IsContactLaw Contact>
void add_forces(Mirror& mirror, const Law& bond, const Contact& contact, double dt,
                Particles& p, PairLosses& losses)
{
  mirror.force.clear();
  for (MirrorPair& m : mirror.pairs) {
    const ParticleState& b = p.state[m.particle];
    if (b.x.y() < 0.0)
      throw NumericalError("particle " + std::to_string(p.id[m.particle]) +
                           " passed through the symmetry plane");
    const double gap = image_gap(b);
    double pull = 0.0; // towards the image
    if (m.bond.intact > 0.0) {
      const auto force = [&](const Law& law) {
        return image_bond_force(law, dt, gap, p, m, losses);
      };
      pull += p.strength.empty()
                  ? force(bond)
                  : force(with_strengths_times(strength_of(p, m.particle), bond));
    }
    const double overlap = activation_gap(contact) * b.S - gap;
    if (overlap > 0.0) pull -= normal_force(contact, sides_at_mirror(b.R), overlap);
    p.load[m.particle].f.y() -= pull;
    mirror.force.y.add(-pull);
  }
}

} // namespace

void add_wall_forces(Mirror& mirror, const PairMaterials& material, double dt, Particles& p,
                     PairLosses& losses)
{
  std::visit([&](const auto& bond,
                 const auto& contact) { add_forces(mirror, bond, contact, dt, p, losses); },
             material.bond, material.contact);
}

EnergySum stored_energy(const Mirror& mirror, const PairMaterials& material,
                        const Particles& p)
{
  EnergySum e;
  for (const MirrorPair& m : mirror.pairs) {
    const ParticleState& b = p.state[m.particle];
    const double gap = image_gap(b);
    if (m.bond.intact > 0.0) {
      const auto shape = bond_shape(section(material.bond), b.R, 0.5 / b.R);
      e.add(0.5 * m.bond.intact * spring_energy(shape, image_bond_load(shape, m, gap)));
    }
    const double overlap = activation_gap(material.contact) * b.S - gap;
    if (overlap > 0.0)
      e.add(0.5 * contact_energy(material.contact, sides_at_mirror(b.R), overlap, 0.0));
  }
  return e;
}

void constrain_mirror_spin(const Mirror& mirror, Particles& p)
{
  for (const MirrorPair& m : mirror.pairs)
    if (m.bond.intact > 0.0) p.load[m.particle].t.x() = p.load[m.particle].t.z() = 0.0;
}

} // namespace mergel::dem
