#include "dem/walls/triangulated.h"

#include "dem/pairs/strength.h"
#include "dem/particles/kinematics.h"

namespace mergel::dem {

Wall make_wall(const std::vector<Vec3>& x, std::vector<Triangle> triangles,
               const ContactLaw& material)
{
  Wall wall;
  wall.topology = make_topology(x, std::move(triangles));
  wall.x = x;
  wall.v.assign(x.size(), Vec3::Zero());
  wall.f.resize(x.size());
  wall.material = material;
  update_normals(wall);
  return wall;
}

EnergySum stored_energy(const Wall& wall)
{
  EnergySum e;
  for (const WallContact& c : wall.contacts) e.add(c.energy);
  for (const WallBond& b : wall.bonds) e.add(b.energy);
  return e;
}

double power(const Wall& wall)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < wall.f.size(); ++k) sum -= wall.f[k].value().dot(wall.v[k]);
  return sum;
}

Vec3 at(const std::vector<Vec3>& nodal, const WallTopology& topo, const Anchor& a)
{
  const Triangle& t = topo.triangles[uz(a.triangle)];
  return a.weight[0] * nodal[uz(t[0])] + a.weight[1] * nodal[uz(t[1])] +
         a.weight[2] * nodal[uz(t[2])];
}

namespace {

/// Add the force of a wall bond to its particle and update the bond. Returns the force on
/// the particle [N]; -f acts on the wall at x_a.
template <IsBondLaw Law>
Vec3 add_wall_bond(const Law& material, bool yields, double dt, const Vec3& x_a,
                   const Vec3& v_a, Particles& p, WallBond& bond, PairLosses& losses)
{
  const ParticleState& b = p.state[bond.particle];
  const End<double> particle{triple(b.x), b.R, triple(b.v), b.S, triple(b.omega)};
  const End<double> wall{triple(x_a), 0.0, triple(v_a), b.S, Triple<double>{}};
  const auto k = pair_motion(particle, wall, dt, 1.0);
  const auto shape = bond_shape(material, b.R, 1.0 / b.R);

  const Triple<double> V = rotated_with_contact(triple(bond.V), k);
  EffectiveLoads<double> load{shape.k_n * (k.gap - bond.gap_0 - bond.state.u_p),
                              V + k.du_s * shape.k_s, Triple<double>{}};
  if (yields && !is_elastic(material, shape, load)) {
    const EffectiveLoads<double> old{load.N - shape.k_n * k.du_n, V, Triple<double>{}};
    if (bond_step(material, shape, b.S, old, load, bond.state, &losses).breaks) {
      --p.n_bonds[bond.particle];
      bond.V.setZero();
      bond.energy = 0.0;
      return Vec3::Zero();
    }
  }
  bond.V = vec3(load.V);
  bond.energy = bond.state.intact * spring_energy(shape, load);
  const Vec3 f = bond.state.intact * vec3(k.n * load.N + load.V);
  p.load[bond.particle].f += f;
  p.load[bond.particle].t += (x_a - b.x).cross(f);
  return f;
}

void add_to_nodes(Wall& wall, const Anchor& a, const Vec3& f)
{
  const Triangle& t = wall.topology.triangles[uz(a.triangle)];
  for (int k = 0; k < 3; ++k)
    if (a.weight[k] != 0.0) wall.f[uz(t[uz(k)])].add(a.weight[k] * f);
}

/// Of the shear spring of a contact [J].
template <IsContactLaw Law>
double shear_energy(const Law& law, double R, const WallContact& c)
{
  return 0.5 * c.f_s.squaredNorm() /
         contact_stiffness(law, sides_at_wall(R), c.overlap).k_s;
}

template <IsContactLaw Law>
void add_contacts(Wall& wall, const Law& law, double dt, Particles& p, PairLosses& losses)
{
  const double moved = travel(wall);
  for (std::size_t c = 0; c < wall.contacts.size(); ++c) {
    WallContact& contact = wall.contacts[c];
    ParticleState& particle = p.state[contact.particle];
    std::optional<PatchContact> patch;
    if (!wall.listed[c].is_apart(particle, moved))
      patch = with_particle_id(p.id[contact.particle], [&] {
        return patch_contact(wall, wall.listed[c], particle, moved);
      });
    if (!patch) {
      if (contact.f_s != Vec3::Zero()) // the contact opens and loses its shear energy
        losses.slip.add(shear_energy(law, particle.R, contact));
      contact.f_s.setZero();
      contact.energy = contact.overlap = 0.0;
      continue;
    }
    const Vec3 f = add_wall_contact(law, patch->geometry, dt, particle,
                                    p.load[contact.particle], contact, losses);
    for (std::size_t s = 0; s < patch->n; ++s)
      add_to_nodes(wall, patch->shares[s].at, -patch->shares[s].weight * f);
    wall.contact_forces.push_back({f, patch->geometry.point, patch->geometry.v});
  }
}

} // namespace

void add_wall_forces(Wall& wall, const PairMaterials& material, double dt, Particles& p,
                     PairLosses& losses)
{
  for (VectorSum& f : wall.f) f.clear();
  wall.contact_forces.clear();

  std::visit([&](const auto& law) { add_contacts(wall, law, dt, p, losses); },
             wall.material);

  for (WallBond& b : wall.bonds) {
    if (b.state.intact == 0.0) continue;
    const Vec3 x_a = at(wall.x, wall.topology, b.anchor);
    const Vec3 v_a = at(wall.v, wall.topology, b.anchor);
    const Vec3 f = std::visit(
        [&](const auto& bond) {
          return add_wall_bond(with_strengths_times(strength_of(p, b.particle), bond),
                               wall.bonds_yield, dt, x_a, v_a, p, b, losses);
        },
        material.bond);
    add_to_nodes(wall, b.anchor, -f);
    wall.contact_forces.push_back({f, x_a, v_a});
  }
}

WallSums sum_contact_forces(const Wall& wall)
{
  WallSums sums;
  for (const WallContactForce& force : wall.contact_forces) {
    sums.force.add(force.f);
    sums.moment.add(force.point.cross(force.f));
    sums.power.add(-force.f.dot(force.v));
  }
  return sums;
}

} // namespace mergel::dem
