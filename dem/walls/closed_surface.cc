#include "dem/walls/closed_surface.h"

#include "dem/error.h"
#include "dem/text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <utility>

namespace mergel::dem {

namespace {

/// Area over the square of the longest edge below which a triangle counts as having none: the
/// coordinates of a binary file have 24 bits.
constexpr double smallest_area = 1e-9;

const char* const repair = "Repair the surface in the program that made it, or in a mesh "
                           "editor, and export it again";

std::string text_of(const Vec3& x)
{
  return "(" + shortest(x.x()) + ", " + shortest(x.y()) + ", " + shortest(x.z()) + ")";
}

std::string number(std::size_t t)
{
  return "triangle " + std::to_string(t + 1);
}

using Edge = std::pair<int, int>;

Edge edge_of(const Triangle& t, std::size_t k)
{
  return {t[k], t[(k + 1) % 3]};
}

/// Directed edge -> triangle.
using Edges = std::map<Edge, std::size_t>;

std::string edge_text(const ClosedSurface& s, const Edge& e)
{
  return "edge from " + text_of(s.x[uz(e.first)]) + " to " + text_of(s.x[uz(e.second)]);
}

Edges edges_of(const ClosedSurface& s)
{
  Edges edges;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e = edge_of(s.triangles[t], k);
      const auto [there, is_new] = edges.emplace(e, t);
      require(is_new, number(there->second) + " and " + number(t) + " run along the " +
                          edge_text(s, e) +
                          " in the same direction: one of them is the wrong way round, or "
                          "the edge has more than two triangles. " +
                          repair);
    }
  for (const auto& [e, t] : edges)
    require(edges.contains({e.second, e.first}),
            "the surface is open: no other triangle has the " + edge_text(s, e) + " of " +
                number(t) +
                ". It must be closed, and corners that meet must have the same "
                "coordinates. " +
                repair);
  return edges;
}

/// The triangles around each point must be one ring.
void require_rings(const ClosedSurface& s, const Edges& edges)
{
  std::vector<std::size_t> n_around(s.x.size(), 0), any(s.x.size(), 0);
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (const int node : s.triangles[t]) {
      ++n_around[uz(node)];
      any[uz(node)] = t;
    }
  for (std::size_t node = 0; node < s.x.size(); ++node) {
    std::size_t n = 0, t = any[node];
    do {
      const Triangle& k = s.triangles[t];
      const std::size_t here = place_of(static_cast<int>(node), k);
      t = edges.at({k[here], k[(here + 2) % 3]}); // across the edge that ends here
      ++n;
    } while (t != any[node] && n <= n_around[node]);
    require(n == n_around[node], "parts of the surface touch at the point " +
                                     text_of(s.x[node]) + " only. " + repair);
  }
}

std::size_t count_reached(const ClosedSurface& s, const Edges& edges)
{
  std::vector<bool> is_reached(s.triangles.size(), false);
  std::vector<std::size_t> open{0};
  is_reached[0] = true;
  std::size_t n = 0;
  while (!open.empty()) {
    const std::size_t t = open.back();
    open.pop_back();
    ++n;
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e = edge_of(s.triangles[t], k);
      const std::size_t other = edges.at({e.second, e.first});
      if (is_reached[other]) continue;
      is_reached[other] = true;
      open.push_back(other);
    }
  }
  return n;
}

} // namespace

ClosedSurface join_corners(const std::vector<std::array<Vec3, 3>>& triangles)
{
  ClosedSurface s;
  std::map<std::array<double, 3>, int> known;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const double area = (b - a).cross(c - a).norm(),
                 longest = std::max(
                     {(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    require(area > smallest_area * longest,
            number(t) + ", with a corner at " + text_of(a) +
                ", has no area. Remove such triangles in a mesh editor, and close the gaps "
                "that they leave");
    Triangle k{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 x = triangles[t][corner] + Vec3::Zero(); // -0 is 0
      const auto [at, is_new] =
          known.emplace(std::array{x.x(), x.y(), x.z()}, static_cast<int>(s.x.size()));
      if (is_new) s.x.push_back(x);
      k[corner] = at->second;
    }
    s.triangles.push_back(k);
  }
  return s;
}

namespace {

/// Call for each triangle with six times the volume of its tetrahedron with the first point, and
/// its corners from there: near, for little round-off.
template <class Visit>
void for_tetrahedra(const ClosedSurface& s, Visit&& visit)
{
  for (const Triangle& t : s.triangles) {
    const Vec3 a = s.x[uz(t[0])] - s.x.front(), b = s.x[uz(t[1])] - s.x.front(),
               c = s.x[uz(t[2])] - s.x.front();
    visit(a.cross(b).dot(c), a, b, c);
  }
}

} // namespace

double volume(const ClosedSurface& s)
{
  double six = 0.0;
  for_tetrahedra(s, [&](double V, const Vec3&, const Vec3&, const Vec3&) { six += V; });
  return six / 6.0;
}

Vec3 centre_of_volume(const ClosedSurface& s)
{
  Vec3 sum = Vec3::Zero();
  for_tetrahedra(s, [&](double V, const Vec3& a, const Vec3& b, const Vec3& c) {
    sum += V / 24.0 * (a + b + c);
  });
  return s.x.front() + sum / volume(s);
}

void require_closed(const ClosedSurface& s)
{
  require(s.triangles.size() >= 4, "has " + std::to_string(s.triangles.size()) +
                                       " triangles: a closed surface has four or more");
  const Edges edges = edges_of(s);
  require_rings(s, edges);
  const std::size_t reached = count_reached(s, edges);
  require(reached == s.triangles.size(),
          "has several surfaces: only " + std::to_string(reached) + " of its " +
              std::to_string(s.triangles.size()) +
              " triangles hang together with the first one. Join them, and "
              "leave out hollows");
  require(
      volume(s) > 0.0,
      "is inside out: the normals of its triangles, by the right-hand rule, point "
      "inwards. Reverse the triangles, in a mesh editor \"flip\" or \"invert normals\"");
}

} // namespace mergel::dem
