#include "coupling/interface_stiffness.h"

#include <algorithm>

namespace mergel::coupling {

using dem::uz;

std::vector<double> interface_stiffness(const dem::Assembly& assembly,
                                        const dem::Wall& wall_of_lists,
                                        const Transfer& transfer)
{
  // From the present positions: the result must not depend on when the lists were built.
  dem::Wall wall = wall_of_lists;
  dem::rebuild_wall(wall, assembly.material, assembly.particles, assembly.list.skin());
  std::vector<dem::ForceSum> sums(wall.x.size()); // [N/m]
  const auto add = [&](int triangle, const dem::Vec3& weight, double k) {
    const dem::Triangle& t = wall.topology.triangles[uz(triangle)];
    for (int c = 0; c < 3; ++c) sums[uz(t[uz(c)])].add(weight[c] * k);
  };
  const auto radius = [&](dem::Index i) { return assembly.particles.state[i].R; };
  for (const dem::WallBond& b : wall.bonds) {
    const double R = radius(b.particle);
    if (b.state.intact > 0.0)
      add(b.anchor.triangle, b.anchor.weight,
          dem::bond_shape(dem::section(assembly.material.bond), R, 1.0 / R).k_n);
  }
  for (std::size_t k = 0; k < wall.contacts.size(); ++k) {
    const double R = radius(wall.contacts[k].particle);
    for (const auto& near : wall.listed[k].near)
      add(near.triangle, dem::Vec3::Ones(),
          dem::contact_stiffness(
              wall.material, dem::sides_at_wall(R),
              std::max(wall.contacts[k].overlap, dem::estimated_overlap * R))
              .k_n);
  }
  dem::ExactReduction all;
  for (dem::ForceSum& s : sums) all.add(s);
  all.run(assembly.comm);
  Nodal k_wall, k_s;
  for (const dem::ForceSum& s : sums) k_wall.emplace_back(s.value(), 0.0, 0.0);
  transfer.to_structure(k_wall, k_s);
  std::vector<double> k(k_s.size());
  for (std::size_t n = 0; n < k.size(); ++n) k[n] = k_s[n].x();
  return k;
}

} // namespace mergel::coupling
