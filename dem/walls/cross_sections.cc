#include "dem/walls/cross_sections.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mergel::dem {

namespace {

/// Heights over the length of the polyhedron that count as one: round-off of a file.
constexpr double same_height = 1e-6;
constexpr double same_area = 1e-6;
/// Where in an interval its area is computed; a parabola through these is exact.
constexpr std::array<double, 3> places{1.0 / 6.0, 1.0 / 2.0, 5.0 / 6.0};

struct Interval {
  double low, high;
};

/// Between the heights of the corners, from below.
std::vector<Interval> intervals_of(const std::vector<Vec3>& x)
{
  std::vector<double> z;
  for (const Vec3& a : x) z.push_back(a.z());
  std::sort(z.begin(), z.end());
  const double smallest = same_height * (z.back() - z.front());
  std::vector<Interval> all;
  for (std::size_t k = 1; k < z.size(); ++k)
    if (z[k] - z[k - 1] > smallest) all.push_back({z[k - 1], z[k]});
  return all;
}

/// Twice the area that the cut of a triangle spans with the axis, counter-clockwise positive.
double twice_area(const std::array<Vec3, 3>& t, double z)
{
  std::array<Vec3, 2> cut;
  std::size_t n = 0;
  for (std::size_t k = 0; k < 3 && n < 2; ++k) {
    const Vec3 &a = t[k], &b = t[(k + 1) % 3];
    if ((a.z() < z) == (b.z() < z)) continue;
    cut[n++] = a + (z - a.z()) / (b.z() - a.z()) * (b - a); // they differ
  }
  if (n < 2) return 0.0;
  const Vec3 outward = (t[1] - t[0]).cross(t[2] - t[0]), along = cut[1] - cut[0];
  const double side = outward.x() * along.y() - outward.y() * along.x();
  return std::copysign(1.0, side) * (cut[0].x() * cut[1].y() - cut[0].y() * cut[1].x());
}

double radius_of(double area)
{
  return std::sqrt(std::max(0.0, area) / pi);
}

} // namespace

std::vector<SectionCircle> cross_sections(const ClosedSurface& s)
{
  const std::vector<Interval> intervals = intervals_of(s.x);
  std::vector<double> z, area;
  for (const Interval& i : intervals)
    for (const double place : places) z.push_back(i.low + place * (i.high - i.low));
  area.assign(z.size(), 0.0);
  for (const Triangle& k : s.triangles) {
    const std::array<Vec3, 3> t{s.x[uz(k[0])], s.x[uz(k[1])], s.x[uz(k[2])]};
    const auto [low, high] = std::minmax({t[0].z(), t[1].z(), t[2].z()});
    auto at = std::lower_bound(z.begin(), z.end(), low);
    for (; at != z.end() && *at < high; ++at)
      area[static_cast<std::size_t>(at - z.begin())] += 0.5 * twice_area(t, *at);
  }
  std::vector<SectionCircle> sections;
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    const double a = area[3 * k], b = area[3 * k + 1], c = area[3 * k + 2];
    // The parabola through the three places, at both ends.
    const double slope = 1.5 * (c - a), bend = 4.5 * (a - 2.0 * b + c);
    const double middle = b + 0.25 * bend;
    const auto add = [&](double z_end, double A) {
      sections.push_back({z_end, radius_of(A)});
    };
    add(intervals[k].low, middle - 0.5 * slope);
    const double top = bend < 0.0 ? -0.5 * slope / bend : 1.0; // of the parabola
    if (std::abs(top) < 0.5)
      for (int twice = 0; twice < 2; ++twice)
        add(intervals[k].low + (0.5 + top) * (intervals[k].high - intervals[k].low),
            b - 0.25 * slope * slope / bend);
    add(intervals[k].high, middle + 0.5 * slope);
  }
  return sections;
}

SectionCircle largest(const std::vector<SectionCircle>& sections)
{
  double R = 0.0;
  for (const SectionCircle& c : sections) R = std::max(R, c.R);
  for (const SectionCircle& c : sections)
    if (c.R * c.R >= (1.0 - same_area) * R * R) return {c.z, R};
  return {};
}

double radius_at(const std::vector<SectionCircle>& sections, double z)
{
  for (std::size_t k = 0; k + 1 < sections.size(); k += 2) {
    const SectionCircle &a = sections[k], &b = sections[k + 1];
    if (z >= a.z && z < b.z)
      return a.R + (b.R - a.R) * (z - a.z) / (b.z - a.z); // b.z > a.z
  }
  return 0.0;
}

} // namespace mergel::dem
