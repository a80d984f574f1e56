/// Closed surfaces of a few polyhedra.
#pragma once

#include "dem/walls/rigid_wall.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace mergel::dem::test {

/// The polyhedron that a profile encloses on its way around the axis z, with n chords. The
/// profile runs from its lowest to its highest point; where it begins or ends off the axis the
/// face is flat.
inline ClosedSurface revolved(const std::vector<Revolution::Corner>& profile, int n)
{
  ClosedSurface s;
  std::vector<int> first; // point of each ring; -1 - number for a point on the axis
  const auto on_axis = [&](double z) {
    s.x.emplace_back(0.0, 0.0, z);
    return -static_cast<int>(s.x.size());
  };
  if (profile.front().r > 0.0) first.push_back(on_axis(profile.front().z));
  for (const auto& [r, z] : profile) {
    if (r == 0.0) {
      first.push_back(on_axis(z));
      continue;
    }
    first.push_back(static_cast<int>(s.x.size()));
    for (int k = 0; k < n; ++k) {
      const double phi = 2.0 * pi * k / n;
      s.x.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
  }
  if (profile.back().r > 0.0) first.push_back(on_axis(profile.back().z));
  for (std::size_t ring = 0; ring + 1 < first.size(); ++ring)
    for (int k = 0; k < n; ++k) {
      const int next = (k + 1) % n, a = first[ring], b = first[ring + 1];
      if (a < 0) {
        s.triangles.push_back({-a - 1, b + next, b + k});
      } else if (b < 0) {
        s.triangles.push_back({a + k, a + next, -b - 1});
      } else {
        s.triangles.push_back({a + k, a + next, b + next});
        s.triangles.push_back({a + k, b + next, b + k});
      }
    }
  return s;
}

/// A cone-ended pile of this length.
inline ClosedSurface cone_ended_surface(double R, double height, double length, int n)
{
  return revolved({{0.0, 0.0}, {R, height}, {R, length}}, n);
}

/// A prism over a polygon in the plane z = 0, counter-clockwise, whose first point sees all of it.
inline ClosedSurface prism(const std::vector<std::array<double, 2>>& polygon, double height)
{
  ClosedSurface s;
  const int n = static_cast<int>(polygon.size());
  for (const double z : {0.0, height})
    for (const auto& [x, y] : polygon) s.x.emplace_back(x, y, z);
  for (int k = 1; k + 1 < n; ++k) {
    s.triangles.push_back({0, k + 1, k});
    s.triangles.push_back({n, n + k, n + k + 1});
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    s.triangles.push_back({k, next, n + next});
    s.triangles.push_back({k, n + next, n + k});
  }
  return s;
}

/// a by b, with its axis in the middle.
inline ClosedSurface box(double a, double b, double height)
{
  return prism({{{-a / 2, -b / 2}, {a / 2, -b / 2}, {a / 2, b / 2}, {-a / 2, b / 2}}},
               height);
}

inline std::string ascii_stl(const ClosedSurface& s)
{
  std::string text = "solid pile\n";
  for (const Triangle& t : s.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int k : t) {
      const Vec3& x = s.x[uz(k)];
      char line[120];
      std::snprintf(line, sizeof line, "   vertex %.9g %.9g %.9g\n", x.x(), x.y(), x.z());
      text += line;
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid pile\n";
}

inline std::string binary_stl(const ClosedSurface& s)
{
  const auto n = static_cast<std::uint32_t>(s.triangles.size());
  std::string bytes = "solid in name only";
  bytes.resize(80, '\0');
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(n);
  for (const Triangle& t : s.triangles) {
    for (int k = 0; k < 3; ++k) add(0.0f);
    for (const int k : t)
      for (const double x : s.x[uz(k)]) add(static_cast<float>(x));
    add(std::uint16_t{0});
  }
  return bytes;
}

} // namespace mergel::dem::test
