#include "dem/continuum/loaded_branches.h"

#include "dem/assembly/branches.h"
#include "dem/walls/wall_readings.h"

#include <algorithm>
#include <tuple>

namespace mergel::dem {

std::vector<WallContactForce> gather_wall_forces(const Assembly& assembly)
{
  const auto key = [](const WallContactForce& c) {
    return std::tuple(c.particle, c.point.x(), c.point.y(), c.point.z(), c.f.x(), c.f.y(),
                      c.f.z());
  };
  std::vector<WallContactForce> all;
  for (const Wall& wall : assembly.walls) {
    const auto of_wall = assembly.comm.gather_on_first(wall.contact_forces);
    all.insert(all.end(), of_wall.begin(), of_wall.end());
  }
  std::sort(all.begin(), all.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return all;
}

std::vector<LoadedBranch> loaded_branches(const Assembly& assembly,
                                          const std::vector<WallContactForce>& at_walls)
{
  const Particles& p = assembly.particles;
  std::vector<LoadedBranch> all;
  Pair last{0, 0};
  visit_branches(assembly, [&](const Pair& q, const Branch& b, const Vec3& F) {
    if (!all.empty() && q == last) // the contact of a bonded pair
      all.back().F += F;
    else
      all.push_back({q.i, q.j, BranchEnd::particle, b.r, F, q.shift});
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
  for (const WallContactForce& c : at_walls)
    all.push_back(
        {c.particle, c.particle, BranchEnd::wall, c.point - p.state[c.particle].x, c.f});
  for (const RigidWall& wall : assembly.rigid_walls)
    for (const WallContact& c : wall.contacts) {
      if (c.overlap <= 0.0) continue;
      const RigidContact at = read_contact(wall, c, p);
      all.push_back({c.particle, c.particle, BranchEnd::rigid,
                     at.point - p.state[c.particle].x, at.f});
    }
  return all;
}

std::vector<double> coordination(const Particles& p,
                                 const std::vector<LoadedBranch>& branches)
{
  std::vector<double> n(p.size(), 0.0);
  for (const LoadedBranch& b : branches) {
    if (b.end == BranchEnd::wall || b.end == BranchEnd::rigid) continue;
    n[b.i] += 1.0;
    if (b.end == BranchEnd::particle) n[b.j] += 1.0;
  }
  return n;
}

} // namespace mergel::dem
