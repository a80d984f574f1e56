#include "dem/walls/surface_search.h"

#include "dem/walls/closest_on_triangle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mergel::dem {

namespace {

constexpr std::size_t most_in_leaf = 8;

} // namespace

SurfaceSearch::SurfaceSearch(const std::vector<Vec3>& x,
                             const std::vector<Triangle>& triangles)
    : order_(triangles.size())
{
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(triangles.size());
  std::vector<Vec3> middles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int k : triangles[t]) boxes[t].extend(x[uz(k)]);
    middles.emplace_back(boxes[t].center());
  }
  if (!triangles.empty()) build(boxes, middles, 0, triangles.size());
}

void SurfaceSearch::build(const std::vector<Eigen::AlignedBox3d>& boxes,
                          const std::vector<Vec3>& middles, std::size_t first,
                          std::size_t end)
{
  const std::size_t here = nodes_.size();
  nodes_.push_back({{}, first, end});
  Eigen::AlignedBox3d box, of_middles;
  for (std::size_t k = first; k < end; ++k) {
    box.extend(boxes[uz(order_[k])]);
    of_middles.extend(middles[uz(order_[k])]);
  }
  nodes_[here].box = box;
  if (end - first <= most_in_leaf) return;
  Eigen::Index along = 0;
  of_middles.sizes().maxCoeff(&along);
  const auto from = order_.begin();
  const std::size_t middle = first + (end - first) / 2;
  std::nth_element(
      from + static_cast<std::ptrdiff_t>(first), from + static_cast<std::ptrdiff_t>(middle),
      from + static_cast<std::ptrdiff_t>(end), [&](int a, int b) {
        const double at_a = middles[uz(a)][along], at_b = middles[uz(b)][along];
        return at_a != at_b ? at_a < at_b : a < b;
      });
  build(boxes, middles, first, middle);
  nodes_[here].second = nodes_.size();
  build(boxes, middles, middle, end);
}

void SurfaceSearch::within(const Vec3& c, double reach, std::vector<int>& found) const
{
  found.clear();
  const double limit = reach * reach * (1.0 + 1e-9); // a margin for its round-off
  const auto visit = [&](const auto& self, std::size_t k) -> void {
    const Node& node = nodes_[k];
    if (node.box.squaredExteriorDistance(c) > limit) return;
    if (node.second == 0) {
      found.insert(found.end(), order_.begin() + static_cast<std::ptrdiff_t>(node.first),
                   order_.begin() + static_cast<std::ptrdiff_t>(node.end));
      return;
    }
    self(self, k + 1);
    self(self, node.second);
  };
  if (!nodes_.empty()) visit(visit, 0);
  std::sort(found.begin(), found.end());
}

std::optional<NearestOnSurface>
SurfaceSearch::nearest(const std::vector<Vec3>& x, const std::vector<Triangle>& triangles,
                       const Vec3& c, double reach) const
{
  std::optional<NearestOnSurface> best;
  double limit = reach * reach;
  const auto look_at = [&](int t) {
    const Triangle& k = triangles[uz(t)];
    const ClosestPoint at = closest_on_triangle(c, x[uz(k[0])], x[uz(k[1])], x[uz(k[2])]);
    const double d2 = (at.point - c).squaredNorm();
    if (d2 > limit || (best && d2 == limit && t > best->at.triangle)) return;
    limit = d2;
    best = {{t, at.weight}, at.point, std::sqrt(d2)};
  };
  const auto visit = [&](const auto& self, std::size_t k) -> void {
    const Node& node = nodes_[k];
    if (node.second == 0) {
      for (std::size_t i = node.first; i < node.end; ++i) look_at(order_[i]);
      return;
    }
    std::pair<double, std::size_t> first{nodes_[k + 1].box.squaredExteriorDistance(c),
                                         k + 1},
        second{nodes_[node.second].box.squaredExteriorDistance(c), node.second};
    if (second < first) std::swap(first, second); // the nearer box first
    if (first.first <= limit) self(self, first.second);
    if (second.first <= limit) self(self, second.second);
  };
  if (!nodes_.empty() && nodes_[0].box.squaredExteriorDistance(c) <= limit) visit(visit, 0);
  return best;
}

} // namespace mergel::dem
