#include "dem/continuum/loaded_branches.h"

#include "dem/assembly/branches.h"
#include "dem/parallel/merge_runs.h"
#include "dem/parallel/rows.h"
#include "dem/walls/wall_readings.h"

#include <algorithm>
#include <tuple>

namespace mergel::dem {

namespace {

/// At the triangulated walls, in an order that does not depend on the ranks.
std::vector<WallContactForce> forces_at_walls(const Assembly& assembly)
{
  const auto key = [](const WallContactForce& c) {
    return std::tuple(c.particle, c.point.x(), c.point.y(), c.point.z(), c.f.x(), c.f.y(),
                      c.f.z());
  };
  std::vector<WallContactForce> all;
  for (const Wall& wall : assembly.walls)
    all.insert(all.end(), wall.contact_forces.begin(), wall.contact_forces.end());
  std::sort(all.begin(), all.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return all;
}

} // namespace

std::vector<LoadedBranch> loaded_branches(const Assembly& assembly)
{
  const Particles& p = assembly.particles;
  std::vector<LoadedBranch> all;
  Pair last{0, 0};
  auto bonded = assembly.bonds.pairs.begin();
  const auto end = assembly.bonds.pairs.end();
  visit_branches(
      assembly, [&](const Pair& q) { return p.owns(q.i) || p.owns(q.j); },
      [&](const Pair& q, const Branch& b, const Vec3& F) {
        while (bonded != end && *bonded < q) ++bonded;
        const bool is_bonded = bonded != end && *bonded == q;
        if (!all.empty() && q == last) // the contact of a bonded pair
          all.back().F += F;
        else
          all.push_back({q.i, q.j, BranchEnd::particle, b.r, F, q.shift, is_bonded});
        last = q;
      });
  for (const Mirror& mirror : assembly.mirrors)
    for (const MirrorPair& pair : mirror.pairs) {
      const double N = pull(pair, assembly.material, p);
      if (N == 0.0 && pair.bond.intact == 0.0) continue;
      const double y = p.state[pair.particle].x.y();
      all.push_back(
          {pair.particle, pair.particle, BranchEnd::image, {0.0, -y, 0.0}, {0.0, -N, 0.0}});
    }
  for (const WallContactForce& c : forces_at_walls(assembly))
    all.push_back(
        {c.particle, c.particle, BranchEnd::wall, c.point - p.state[c.particle].x, c.f});
  for (const RigidWall& wall : assembly.rigid_walls)
    for (const WallContact& c : wall.contacts) {
      if (c.overlap <= 0.0) continue;
      for (const RigidContact& at : read_contacts(wall, c, p))
        all.push_back({c.particle, c.particle, BranchEnd::rigid,
                       at.point - p.state[c.particle].x, at.f});
    }
  return all;
}

std::vector<LoadedBranch> gather_loads(const Assembly& assembly,
                                       const std::vector<LoadedBranch>& mine, int to)
{
  std::vector<LoadedBranch> loaded;
  for (const LoadedBranch& b : mine)
    if (assembly.particles.owns(b.i) && b.F != Vec3::Zero()) loaded.push_back(b);
  std::vector<LoadedBranch> all = assembly.comm.gather_on(to, loaded);
  // Those of one particle at one kind of wall come from one rank, and keep their order.
  merge_runs(all, [](const LoadedBranch& a, const LoadedBranch& b) {
    return std::tuple(a.end, !a.is_bonded, a.i, a.j, a.shift) <
           std::tuple(b.end, !b.is_bonded, b.i, b.j, b.shift);
  });
  return all;
}

std::vector<double> coordination(const Particles& p,
                                 const std::vector<LoadedBranch>& branches)
{
  const std::vector<Index> rows = owned_rows(p);
  std::vector<double> n(p.n_owned(), 0.0);
  for (const LoadedBranch& b : branches) {
    if (b.end == BranchEnd::wall || b.end == BranchEnd::rigid) continue;
    if (p.owns(b.i)) n[rows[b.i]] += 1.0;
    if (b.end == BranchEnd::particle && p.owns(b.j)) n[rows[b.j]] += 1.0;
  }
  return n;
}

} // namespace mergel::dem
