#include "dem/pairs/bonds.h"

#include <algorithm>

namespace mergel::dem {

namespace {

double gap_of(const Pair& pair, const Particles& p, const PeriodicCell& cell)
{
  const ParticleState &i = p.state[pair.i], &j = p.state[pair.j];
  return (j.x + cell.offset(pair.shift) - i.x).norm() - (i.R + j.R);
}

} // namespace

Bonds make_bonds(Particles& p, const PeriodicCell& cell, std::vector<Pair> pairs)
{
  Bonds bonds;
  bonds.pairs = std::move(pairs);
  bonds.blocks.assign((bonds.size() + n_lanes - 1) / n_lanes, BondBlock{});
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    BondBlock& block = bonds.blocks[b / n_lanes];
    const auto l = static_cast<int>(b % n_lanes);
    block.gap_0[l] = gap_of(bonds.pairs[b], p, cell);
    block.intact[l] = 1.0;
    ++p.n_bonds[bonds.pairs[b].i];
    ++p.n_bonds[bonds.pairs[b].j];
  }
  return bonds;
}

BondReading read_bond(const Bonds& bonds, std::size_t b, const Particles& p,
                      const PeriodicCell& cell, const BondLaw& law)
{
  const BondBlock& block = bonds.blocks[b / n_lanes];
  const auto l = static_cast<int>(b % n_lanes);
  const Pair& pair = bonds.pairs[b];
  const double R_i = p.state[pair.i].R, R_j = p.state[pair.j].R;
  const double intact = block.intact[l];
  const auto shape = bond_shape(section(law), std::min(R_i, R_j), 1.0 / (R_i + R_j));
  EffectiveLoads<double> q{0.0, lane(block.V, l), lane(block.M, l), block.T[l]};
  if (intact > 0.0)
    q.N = shape.k_n * (gap_of(pair, p, cell) - block.gap_0[l] - block.u_p[l]);
  return {intact * q.N, intact * vec3(q.V), intact * vec3(q.M),
          intact * q.T, 1.0 - intact,       intact * spring_energy(shape, q)};
}

} // namespace mergel::dem
