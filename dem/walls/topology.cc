/// The triangles of a wall: their neighbours, smooth patches and normals.
#include "dem/walls/triangulated.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace mergel::dem {

namespace {

Vec3 area_vector(const std::vector<Vec3>& x, const Triangle& t)
{
  const auto at = [&](int k) {
    return x[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
  };
  return 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
}

} // namespace

WallTopology make_topology(const std::vector<Vec3>& x, std::vector<Triangle> triangles,
                           double cos_fold)
{
  WallTopology topo;
  topo.triangles = std::move(triangles);
  const std::size_t n = topo.triangles.size();
  topo.across.assign(n, {-1, -1, -1});
  topo.around.resize(x.size());

  std::vector<Vec3> normal(n);
  std::map<std::pair<int, int>, std::pair<int, int>>
      edges; // directed edge -> triangle, edge
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle& k = topo.triangles[t];
    for (const int m : k)
      require(m >= 0 && uz(m) < x.size(),
              "wall triangle " + std::to_string(t) + " has node " + std::to_string(m) +
                  ", but the wall has " + std::to_string(x.size()) +
                  " nodes (numbered from 0)");
    const Vec3 a = area_vector(x, k);
    require(a.norm() > 0.0, "wall triangle " + std::to_string(t) + " has no area");
    normal[t] = a.normalized();
    for (int e = 0; e < 3; ++e) {
      const std::pair edge{k[uz(e)], k[uz((e + 1) % 3)]};
      require(
          edges.emplace(edge, std::pair{static_cast<int>(t), e}).second,
          "wall triangle " + std::to_string(t) +
              " has an edge in the same direction as another triangle: reverse its normal, "
              "or split an edge of more than two triangles");
      topo.around[uz(k[uz(e)])].push_back(static_cast<int>(t));
    }
  }
  for (const auto& [edge, here] : edges) {
    const auto there = edges.find({edge.second, edge.first});
    if (there == edges.end()) continue;
    const int other = there->second.first;
    if (normal[uz(here.first)].dot(normal[uz(other)]) < cos_fold) continue;
    topo.across[uz(here.first)][uz(here.second)] = other;
  }

  topo.patch.assign(n, -1);
  for (std::size_t t = 0; t < n; ++t) {
    if (topo.patch[t] >= 0) continue;
    std::vector<int> open{static_cast<int>(t)};
    topo.patch[t] = topo.n_patches;
    while (!open.empty()) {
      const int k = open.back();
      open.pop_back();
      for (const int other : topo.across[uz(k)])
        if (other >= 0 && topo.patch[uz(other)] < 0) {
          topo.patch[uz(other)] = topo.n_patches;
          open.push_back(other);
        }
    }
    ++topo.n_patches;
  }

  topo.n_fans.assign(n, {1, 1, 1});
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int node = topo.triangles[t][k];
      std::uint8_t fans = 0;
      for (const int around : topo.around[uz(node)]) {
        const std::size_t here = place_of(node, topo.triangles[uz(around)]);
        if (topo.patch[uz(around)] == topo.patch[t] && topo.across[uz(around)][here] < 0)
          ++fans;
      }
      if (fans > 1) topo.n_fans[t][k] = fans;
    }
  return topo;
}

Vec3 normal(const Wall& wall, int t)
{
  return area_vector(wall.x, wall.topology.triangles[uz(t)]).normalized();
}

} // namespace mergel::dem
