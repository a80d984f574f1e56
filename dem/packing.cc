#include "dem/packing.h"

#include "dem/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace mergel::dem {

namespace {

/// Spheres with their shells cannot fill more of a region at random: monodisperse random
/// close packing is 0.64, gradings and soft shells reach a little more.
constexpr double densest_fraction = 0.68;

/// Of the distance: more than this is a packing under pressure, some 10 kPa for grains of 1 GPa.
constexpr double jammed_overlap = 1e-3;

double chord_angle(const HalfCylinder& c)
{
  return pi / c.segments;
}

/// Angle of the outward normal of the chord that x lies behind.
double chord_direction(const HalfCylinder& c, const Vec3& x)
{
  const double phi = std::clamp(std::atan2(x.y(), x.x()), 0.0, pi);
  const int k = std::clamp(static_cast<int>(phi / chord_angle(c)), 0, c.segments - 1);
  return (k + 0.5) * chord_angle(c);
}

/// Mean cube of the diameters at S = 1, uniform in number [m^3].
double mean_cube(const SpecimenSpec& s)
{
  return 0.25 * (s.d_max * s.d_max + s.d_min * s.d_min) * (s.d_max + s.d_min);
}

/// Interleave the bits of three 10-bit numbers.
std::uint32_t morton(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  std::uint32_t code = 0;
  for (std::uint32_t b = 0; b < 10; ++b)
    code |= ((x >> b) & 1u) << (3 * b) | ((y >> b) & 1u) << (3 * b + 1) |
            ((z >> b) & 1u) << (3 * b + 2);
  return code;
}

} // namespace

double HalfCylinder::volume() const
{
  return height * segments * 0.5 * radius * radius * std::sin(chord_angle(*this));
}

double HalfCylinder::side_clearance(const Vec3& x) const
{
  const double apothem = radius * std::cos(0.5 * chord_angle(*this));
  return apothem + x.dot(side_normal(x));
}

Vec3 HalfCylinder::side_normal(const Vec3& x) const
{
  const double phi = chord_direction(*this, x);
  return {-std::cos(phi), -std::sin(phi), 0.0};
}

double GradedScale::at(double r) const
{
  if (r <= r_inner) return S_inner;
  if (r >= r_outer) return S_outer;
  return S_inner + (S_outer - S_inner) * (r - r_inner) / (r_outer - r_inner);
}

void SpecimenSpec::check() const
{
  require(region.radius > 0.0 && region.height > 0.0 && region.segments > 1,
          "the region must have a size and at least two chords");
  require(scale.S_inner > 0.0 && scale.S_outer > 0.0, "upscaling ratios must be positive");
  require(d_min > 0.0 && d_max >= d_min, "grain diameters must be positive and ascend");
  require(porosity > 0.0 && porosity < 1.0, "porosity must lie in (0, 1)");
  require(most_grains(*this) <= grains_limit, "the region may hold more than 2e7 grains: "
                                              "raise the upscaling ratio or the diameters");
  const double fraction = effective_solid_fraction(*this);
  if (fraction > densest_fraction) {
    const double lowest = 1.0 - (1.0 - porosity) * densest_fraction / fraction;
    std::ostringstream text;
    text.precision(3);
    text << "must be at least " << lowest
         << " with this grading and activation gap: spheres with their "
         << "far-field shell would fill " << fraction
         << " of the volume, at random they fill at most " << densest_fraction
         << ". Raise the porosity or lower the activation gap";
    throw InputError(text.str());
  }
  const double largest = d_max * std::max(scale.S_inner, scale.S_outer);
  require(largest < 0.5 * std::min(region.radius, region.height),
          "the largest grain does not fit the region");
}

double most_grains(const SpecimenSpec& s)
{
  const double S = std::min(s.scale.S_inner, s.scale.S_outer);
  return (1.0 - s.porosity) * s.region.volume() / (pi / 6.0 * mean_cube(s) * S * S * S);
}

double effective_solid_fraction(const SpecimenSpec& s)
{
  // Mean of (d + g_a)^3 over a uniform d, relative to the mean of d^3; S cancels.
  const auto quartic = [](double d) { return d * d * d * d; };
  const double a = s.d_min + s.g_a, b = s.d_max + s.g_a;
  const double shelled =
      b > a ? (quartic(b) - quartic(a)) / (4.0 * (b - a)) : a * a * a; // both are positive
  return (1.0 - s.porosity) * shelled / mean_cube(s);
}

namespace {

/// Diameters, ratios and ids of grains of this total volume [m^3], at random places, with
/// overlaps.
Particles draw_grains(const SpecimenSpec& s, double target)
{
  const double S_least = std::min(s.scale.S_inner, s.scale.S_outer);
  std::vector<Body> born;
  double volume = 0.0;
  for (std::uint64_t trial = 0;; ++trial) {
    const auto u = [&](std::uint64_t draw) { return uniform(s.seed, trial, draw); };
    Body b;
    b.x = {s.region.radius * (2.0 * u(0) - 1.0), s.region.radius * u(1),
           -s.region.height * u(2)};
    if (s.region.side_clearance(b.x) < 0.0) continue;
    b.S = s.scale.at(std::hypot(b.x.x(), b.x.y()));
    const double keep = S_least / b.S;
    if (u(3) > keep * keep * keep) continue;
    b.R = 0.5 * b.S * (s.d_min + (s.d_max - s.d_min) * u(4));
    b.m = sphere_mass(b.R, s.rho);
    const double v = sphere_mass(b.R, 1.0);
    if (volume + 0.5 * v > target) break; // the nearest whole number of grains
    volume += v;
    born.push_back(b);
  }

  std::vector<std::size_t> order(born.size());
  std::iota(order.begin(), order.end(), 0u);
  const double edge = 2.0 * std::max(s.region.radius, s.region.height) / 1023.0;
  std::vector<std::uint32_t> code(born.size());
  for (std::size_t k = 0; k < born.size(); ++k) {
    const Vec3 x = (born[k].x + Vec3(s.region.radius, 0.0, s.region.height)) / edge;
    code[k] = morton(static_cast<std::uint32_t>(x.x()), static_cast<std::uint32_t>(x.y()),
                     static_cast<std::uint32_t>(x.z()));
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair{code[a], a} < std::pair{code[b], b};
  });
  Particles p;
  for (const std::size_t k : order) p.add(born[k]);
  return p;
}

/// Grow the radii from this fraction to 1 and push overlaps apart until none exceeds the
/// tolerance, relative to the pair's distance, or the sweeps are spent. Returns the largest
/// that is left.
double grow(const SpecimenSpec& s, Particles& p, double from, double tolerance,
            int most_sweeps, const std::function<void(double)>& progress)
{
  const int n_growing = from < 1.0 ? 150 : 0; // sweeps over which the radii grow
  constexpr double relaxation =
      0.3; // of each overlap removed per sweep; 1/3 is the limit at 12 neighbours
  constexpr double memory = 0.8; // heavy ball
  const double skin = 0.3 * s.d_min;
  const PeriodicCell open;

  std::vector<Pair> pairs;
  std::vector<Vec3> x_listed, push(p.size()), move(p.size(), Vec3::Zero());
  double worst = 0.0;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool stale = x_listed.empty();
    for (std::size_t i = 0; !stale && i < p.size(); ++i)
      stale = (p.body[i].x - x_listed[i]).norm() > 0.5 * skin * p.body[i].S;
    if (stale) {
      pairs = find_pairs(p, open, s.g_a + skin);
      x_listed.resize(p.size());
      for (std::size_t i = 0; i < p.size(); ++i) x_listed[i] = p.body[i].x;
    }

    const double size = sweep < n_growing ? from + (1.0 - from) * sweep / n_growing : 1.0;
    worst = 0.0;
    std::fill(push.begin(), push.end(), Vec3::Zero());
    for (const Pair& q : pairs) {
      const Body &i = p.body[q.i], &j = p.body[q.j];
      const double reach = size * (i.R + j.R + 0.5 * s.g_a * (i.S + j.S));
      const Vec3 r = j.x - i.x;
      const double d2 = r.squaredNorm();
      if (d2 >= reach * reach) continue;
      const double d = std::sqrt(d2), overlap = reach - d;
      worst = std::max(worst, overlap / reach);
      const Vec3 n = d > 0.0 ? Vec3(r / d) : Vec3::UnitX();
      push[q.i] -= 0.5 * overlap * n;
      push[q.j] += 0.5 * overlap * n;
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Body& b = p.body[i];
      const double R = size * b.R, shell = R + 0.5 * size * s.g_a * b.S;
      const auto keep = [&](double clearance, double needed, const Vec3& inwards) {
        if (clearance >= needed) return;
        push[i] += (needed - clearance) * inwards;
        worst = std::max(worst, (needed - clearance) / needed);
      };
      keep(s.region.side_clearance(b.x), R, s.region.side_normal(b.x));
      keep(b.x.y(), shell, Vec3::UnitY()); // half of the shell lies on each side of the cut
      keep(-b.x.z(), R, -Vec3::UnitZ());
      keep(b.x.z() + s.region.height, R, Vec3::UnitZ());

      move[i] = memory * move[i] + relaxation * push[i];
      const double limit = 0.2 * b.R, length = move[i].norm();
      if (length > limit) move[i] *= limit / length;
      p.body[i].x += move[i];
    }
    if (sweep % 20 == 0) progress(static_cast<double>(sweep) / most_sweeps);
    if (sweep >= n_growing && worst < tolerance) break;
  }
  return worst;
}

double solid_volume(const Particles& p)
{
  double v = 0.0;
  for (const Body& b : p.body) v += sphere_mass(b.R, 1.0);
  return v;
}

} // namespace

double core_porosity(const SpecimenSpec& s, const Particles& p)
{
  double d_least = std::numeric_limits<double>::infinity(), margin = 0.0;
  for (const Body& b : p.body) {
    d_least = std::min(d_least, 2.0 * b.R);
    margin = std::max(margin, 2.0 * b.R);
  }
  // A hundred million points are enough for any region: 1e-4 of its volume at three digits.
  const double box = 2.0 * s.region.radius * s.region.radius * s.region.height;
  const double h = std::max(0.1 * d_least, std::cbrt(box / 1e8));
  const Vec3 low(-s.region.radius, 0.0, -s.region.height);
  const auto count = [h](double length) { return static_cast<long>(length / h) + 1; };
  const long nx = count(2.0 * s.region.radius), ny = count(s.region.radius),
             nz = count(s.region.height);
  const auto place = [&](long a, long b, long c) {
    return static_cast<std::size_t>((c * ny + b) * nx + a);
  };
  std::vector<bool> solid(static_cast<std::size_t>(nx * ny * nz), false);
  for (const Body& b : p.body) {
    const Vec3 c = (b.x - low) / h;
    const double R = b.R / h;
    const auto from = [R](double x) {
      return std::max(0L, static_cast<long>(std::ceil(x - R)));
    };
    const auto to = [R](double x, long n) {
      return std::min(n - 1, static_cast<long>(x + R));
    };
    for (long k = from(c.z()); k <= to(c.z(), nz); ++k)
      for (long j = from(c.y()); j <= to(c.y(), ny); ++j)
        for (long i = from(c.x()); i <= to(c.x(), nx); ++i) {
          const Vec3 at(static_cast<double>(i), static_cast<double>(j),
                        static_cast<double>(k));
          if ((at - c).squaredNorm() < R * R) solid[place(i, j, k)] = true;
        }
  }
  std::size_t points = 0, filled = 0;
  for (long j = 0; j < ny; ++j)
    for (long i = 0; i < nx; ++i) {
      const Vec3 x = low + h * Vec3(static_cast<double>(i), static_cast<double>(j), 0.0);
      if (x.y() < margin || s.region.side_clearance(x) < margin) continue;
      for (long k = 0; k < nz; ++k) {
        const double height = h * static_cast<double>(k);
        if (height < margin || s.region.height - height < margin) continue;
        ++points;
        filled += solid[place(i, j, k)];
      }
    }
  require(points > 0, "the region has no core: it is not three largest grains wide");
  return 1.0 - static_cast<double>(filled) / static_cast<double>(points);
}

Packing pack(const SpecimenSpec& s, const std::function<void(double)>& progress)
{
  constexpr int most_draws = 5, sweeps_to_judge = 800, sweeps_to_finish = 8000;
  constexpr double tolerance_n = 0.004, tolerance_overlap = 1e-4;
  double solid = 1.0 - s.porosity; // of the whole region
  Packing packing;
  for (int draw = 0; draw < most_draws; ++draw) {
    packing.particles = draw_grains(s, solid * s.region.volume());
    const auto report = [&](double part) { progress((draw + part) / most_draws); };
    packing.overlap =
        grow(s, packing.particles, 0.6, tolerance_overlap, sweeps_to_judge, report);
    packing.porosity = core_porosity(s, packing.particles);
    packing.whole_porosity = 1.0 - solid_volume(packing.particles) / s.region.volume();
    if (std::abs(packing.porosity - s.porosity) < tolerance_n) {
      packing.overlap =
          grow(s, packing.particles, 1.0, tolerance_overlap, sweeps_to_finish, report);
      packing.porosity = core_porosity(s, packing.particles);
      std::ostringstream text;
      text.precision(3);
      text << "cannot be reached unjammed: grains and walls still overlap by "
           << packing.overlap << " of their distance (at most " << jammed_overlap
           << "); raise the porosity or lower `Contact/activation gap`";
      require(packing.overlap <= jammed_overlap, text.str());
      return packing;
    }
    solid += packing.porosity - s.porosity;
  }
  throw InputError("cannot be reached: after " + std::to_string(most_draws) +
                   " draws the core has a porosity of " + std::to_string(packing.porosity) +
                   ", wanted " + std::to_string(s.porosity) +
                   "; enlarge the region or lower the upscaling ratio");
}

Bonding choose_bonds(const SpecimenSpec& s, const Particles& p, const PeriodicCell& cell)
{
  struct Candidate {
    double gap; ///< over S
    Pair pair;
  };
  std::vector<Candidate> candidates;
  for (const Pair& q : find_pairs(p, cell, s.g_b)) {
    const Body &i = p.body[q.i], &j = p.body[q.j];
    const double gap = (j.x + cell.offset(q.shift) - i.x).norm() - (i.R + j.R);
    candidates.push_back({gap / (0.5 * (i.S + j.S)), q});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) {
              return a.gap != b.gap ? a.gap < b.gap : a.pair < b.pair;
            });
  const auto wanted = static_cast<std::size_t>(
      std::llround(0.5 * s.coordination * static_cast<double>(p.size())));
  candidates.resize(std::min(wanted, candidates.size()));

  Bonding bonding;
  for (const Candidate& c : candidates) bonding.pairs.push_back(c.pair);
  if (!candidates.empty()) bonding.limit = candidates.back().gap;
  std::sort(bonding.pairs.begin(), bonding.pairs.end());
  return bonding;
}

SpecimenReport describe(const SpecimenSpec& s, const Particles& p, const Bonding& bonding)
{
  SpecimenReport r;
  r.n_particles = p.n_owned();
  r.n_bonds = bonding.pairs.size();
  r.coordination =
      2.0 * static_cast<double>(r.n_bonds) / static_cast<double>(r.n_particles);
  r.largest_gap = bonding.limit;
  r.effective_fraction = effective_solid_fraction(s);
  r.S_min = r.d_min = std::numeric_limits<double>::infinity();
  for (const Body& b : p.body) {
    r.S_min = std::min(r.S_min, b.S);
    r.S_max = std::max(r.S_max, b.S);
    r.d_min = std::min(r.d_min, 2.0 * b.R);
    r.d_max = std::max(r.d_max, 2.0 * b.R);
  }
  return r;
}

} // namespace mergel::dem
