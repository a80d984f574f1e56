#include "dem/walls/triangulated.h"

#include "dem/math/lane_sum.h"

namespace mergel::dem {

Wall make_wall(const std::vector<Vec3>& x, std::vector<Triangle> triangles,
               const ContactLaw& material)
{
  Wall wall;
  wall.topology = make_topology(x, std::move(triangles));
  wall.x = x;
  wall.v.assign(x.size(), Vec3::Zero());
  wall.f = NodalSums(x.size());
  wall.material = material;
  return wall;
}

EnergySum stored_energy(const Wall& wall, const PairMaterials& material, const Particles& p)
{
  EnergySum e = stored_energy(wall.contacts, wall.material, p);
  for (const WallBond& bond : wall.bonds) {
    if (bond.state.intact == 0.0) continue;
    const ParticleState& b = p.state[bond.particle];
    const auto shape = bond_shape(section(material.bond), b.R, 1.0 / b.R);
    const double gap = (at(wall.x, wall.topology, bond.anchor) - b.x).norm() - b.R;
    const EffectiveLoads<double> load{shape.k_n * (gap - bond.gap_0 - bond.state.u_p),
                                      triple(bond.V), Triple<double>{}};
    e.add(bond.state.intact * spring_energy(shape, load));
  }
  return e;
}

EnergySum work_over(const Wall& wall, double dt)
{
  EnergySum work;
  {
    LaneEnergySum<Row> by_component(work);
    const auto [first, end] = wall.f.own();
    for (std::size_t k = first; k < end; ++k) {
      const Vec3& v = wall.v[k];
      by_component.add(wall.f.row(k) * Row{v.x(), v.y(), v.z(), 0.0} * -dt);
    }
  }
  return work;
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
