#include "dem/specimen/packing.h"

#include "dem/math/morton.h"
#include "dem/math/random.h"
#include "dem/pairs/neighbours.h"
#include "dem/specimen/compaction.h"
#include "dem/specimen/growth.h"
#include "dem/specimen/porosity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <sstream>

namespace mergel::dem {

namespace {

/// Largest volume fraction of particles with their shells in a random packing. Monodisperse
/// random close packing is 0.64; graded sizes and soft shells reach a little more.
constexpr double densest_fraction = 0.68;

/// The same under pressure. Above it particles would overlap by a tenth of their diameter,
/// where the contact law does not represent rock any more.
constexpr double densest_pressed_fraction = 0.9;

/// Largest fraction at which growth finds a packing without pressure. The limit without
/// friction is random close packing, 0.64. Measured: of 6 boxes of 600 and 1500 particles
/// all were unjammed at 0.629, one at 0.637.
constexpr double jammed_fraction = 0.63;

/// Smallest fraction of frictional spheres that bear a pressure. Random loose packing is
/// 0.55 (Onoda and Liniger 1990, Phys. Rev. Lett. 64, 2727); measured 0.52 for a few
/// hundred particles in a box.
constexpr double loosest_fraction = 0.52;

/// Largest overlap of an unjammed packing, over the distance [-]. It causes a pressure of
/// about 10 kPa for a contact modulus of 1 GPa.
constexpr double jammed_overlap = 1e-3;

/// Porosity at which the particles with their shells fill this volume fraction.
double porosity_at(const SpecimenSpec& s, double fraction)
{
  return 1.0 - (1.0 - s.porosity) * fraction / effective_solid_fraction(s); // > 0
}

/// @param n number of particles, or its expected value
void require_several(double n)
{
  if (std::round(n) >= static_cast<double>(fewest_particles)) return;
  char number[32];
  std::snprintf(number, sizeof number, "%.3g", n);
  throw InputError("leaves room for fewer than two particles, for " + std::string(number) +
                   ": lower the porosity or the upscaling ratio, or enlarge the region");
}

} // namespace

double GradedScale::at(double r) const
{
  if (r <= r_inner) return S_inner;
  if (r >= r_outer) return S_outer;
  return S_inner + (S_outer - S_inner) * (r - r_inner) / (r_outer - r_inner);
}

void SpecimenSpec::check() const
{
  dem::check(region);
  require(scale.S_inner > 0.0 && scale.S_outer > 0.0, "upscaling ratios must be positive");
  require(porosity > 0.0 && porosity < 1.0, "porosity must lie in (0, 1)");
  require(max_particles(*this) <= particles_limit,
          "the region may hold more than 2e7 particles: "
          "raise the upscaling ratio or the diameters");
  require(compaction != Compaction::confined || pressure > 0.0,
          "the pressure of a confined specimen must be positive");
  require(friction >= 0.0, "friction must not be negative");
  if (compaction != Compaction::unjammed) dem::check(contact);

  const double fraction = effective_solid_fraction(*this);
  const double most =
      compaction == Compaction::expanded ? densest_pressed_fraction : densest_fraction;
  if (fraction > most) {
    std::ostringstream text;
    text.precision(3);
    text << "must be at least " << porosity_at(*this, most) << " and ";
    if (compaction == Compaction::confined)
      text << "at most about " << porosity_at(*this, loosest_fraction)
           << ", above which particles bear no pressure";
    else
      text << "below 1";
    text << ": at this porosity the particles with their far-field shells would fill "
         << fraction << " of the volume, but "
         << (compaction == Compaction::expanded ? "under pressure" : "at random")
         << " they fill at most " << most << ". Raise the porosity"
         << (activation_gap(contact) > 0.0 ? " or lower the activation gap" : "");
    throw InputError(text.str());
  }
  require(smallest_width(region) > width_needed(*this),
          "the largest particle does not fit the region");
  require_several(max_particles(*this));
}

double width_needed(const SpecimenSpec& s)
{
  const double S = std::max(s.scale.S_inner, s.scale.S_outer);
  if (!std::holds_alternative<PeriodicBox>(s.region)) return 2.0 * S * s.sizes.largest();
  const double margin =
      default_skin + (s.compaction == Compaction::unjammed ? 0.0 : growth_reserve);
  const double range =
      std::max(activation_gap(s.contact) + margin * s.sizes.smallest(), s.g_b);
  return smallest_edge(s.sizes.largest(), range, S);
}

double max_particles(const SpecimenSpec& s)
{
  const double S = std::min(s.scale.S_inner, s.scale.S_outer);
  return (1.0 - s.porosity) * volume(s.region) /
         (pi / 6.0 * s.sizes.mean_cube() * S * S * S);
}

double effective_solid_fraction(const SpecimenSpec& s)
{
  return (1.0 - s.porosity) * s.sizes.mean_cube(activation_gap(s.contact)) /
         s.sizes.mean_cube();
}

namespace {

/// The particles, numbered along a Morton curve.
Particles in_order(const Region& region, const std::vector<ParticleState>& born)
{
  const Bounds box = bounds(region);
  const Vec3 extent = box.high - box.low;
  // Edge of a cell of the 1024^3 Morton grid. The cube is larger than the region: this
  // keeps the numbering of existing samples.
  const double edge = std::max({extent.x(), extent.y(), 2.0 * extent.z()}) / 1023.0; // > 0
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t k = 0; k < born.size(); ++k) {
    const Vec3 x = (born[k].x - box.low) / edge;
    order.emplace_back(morton(static_cast<std::uint32_t>(x.x()),
                              static_cast<std::uint32_t>(x.y()),
                              static_cast<std::uint32_t>(x.z())),
                       k);
  }
  std::sort(order.begin(), order.end());
  Particles p;
  for (const auto& [code, k] : order) p.add(born[k]);
  return p;
}

/// Particles of this total volume [m^3] at random positions, with overlaps: diameters,
/// upscaling ratios and ids.
Particles draw_particles(const SpecimenSpec& s, double target)
{
  const double S_smallest = std::min(s.scale.S_inner, s.scale.S_outer);
  std::vector<ParticleState> born;
  double volume = 0.0;
  for (std::uint64_t trial = 0;; ++trial) {
    const auto u = [&](std::uint64_t draw) { return uniform(s.seed, trial, draw); };
    ParticleState b;
    b.x = place(s.region, {u(0), u(1), u(2)});
    if (depth(s.region, b.x) < 0.0) continue;
    b.S = s.scale.at(axis_distance(s.region, b.x));
    const double keep = S_smallest / b.S;
    if (u(3) > keep * keep * keep) continue;
    b.R = 0.5 * b.S * s.sizes.diameter(u(4));
    b.m = sphere_mass(b.R, s.rho);
    const double v = sphere_mass(b.R, 1.0);
    if (volume + 0.5 * v > target) break; // nearest to the target
    volume += v;
    born.push_back(b);
  }
  return in_order(s.region, born);
}

double grow_packing(const SpecimenSpec& s, Particles& p, const Sweeps& sweeps,
                    const Communicator& comm, const std::function<void(double)>& progress)
{
  Growth growth(p, s.region, activation_gap(s.contact), default_skin * s.sizes.smallest(),
                comm);
  const double overlap = grow(growth, sweeps, progress);
  growth.gather();
  return overlap;
}

/// Move each particle to its image inside the box.
void wrap_into(const PeriodicCell& cell, Particles& p)
{
  for (ParticleState& b : p.state)
    for (int a = 0; a < 3; ++a)
      if (cell.size[a] > 0.0) b.x[a] -= cell.size[a] * std::floor(b.x[a] / cell.size[a]);
}

/// Sweep the grown packing until it is unjammed.
/// @throws InputError when overlaps remain
void finish_unjammed(const SpecimenSpec& s, Packing& packing, double tolerance,
                     const Communicator& comm, const std::function<void(double)>& progress)
{
  constexpr int sweeps_to_finish = 8000;
  packing.overlap = grow_packing(s, packing.particles, {1.0, tolerance, sweeps_to_finish},
                                 comm, progress);
  std::ostringstream text;
  text.precision(3);
  text << "cannot be reached unjammed: particles and walls still overlap by "
       << packing.overlap << " of their distance (at most " << jammed_overlap
       << "); these particles are unjammed at porosities from about "
       << porosity_at(s, jammed_fraction) << " to 1; raise the porosity"
       << (activation_gap(s.contact) > 0.0 ? " or lower `Contact/activation gap`" : "");
  require(packing.overlap <= jammed_overlap, text.str());
}

} // namespace

void measure_porosity(const SpecimenSpec& s, Packing& packing)
{
  Region made = s.region;
  if (auto* box = std::get_if<PeriodicBox>(&made)) box->size = packing.cell.size;
  packing.porosity = core_porosity(made, packing.particles);
  packing.whole_porosity = 1.0 - solid_volume(packing.particles) / volume(made);
}

Packing pack(const SpecimenSpec& s, const std::function<void(double)>& progress,
             MPI_Comm comm)
{
  constexpr int max_draws = 5, sweeps_to_judge = 800;
  constexpr double tolerance_n = 0.004, tolerance_overlap = 1e-4;
  double solid = 1.0 - s.porosity; // of the whole region
  Packing packing;
  packing.cell = cell_of(s.region);
  const Communicator ranks = comm == MPI_COMM_NULL ? Communicator() : Communicator(comm);
  const auto settling = [&](double part) { progress(0.2 + 0.8 * part); };
  for (int draw = 0; draw < max_draws; ++draw) {
    packing.particles = draw_particles(s, solid * volume(s.region));
    require_several(static_cast<double>(packing.particles.size()));
    const auto report = [&](double part) { progress((draw + part) / max_draws); };
    packing.overlap = grow_packing(
        s, packing.particles, {0.6, tolerance_overlap, sweeps_to_judge}, ranks, report);
    measure_porosity(s, packing);
    if (std::abs(packing.porosity - s.porosity) < tolerance_n) {
      switch (s.compaction) {
      case Compaction::unjammed:
        finish_unjammed(s, packing, tolerance_overlap, ranks, report);
        break;
      case Compaction::confined:
        confine(s, packing, comm, settling);
        break;
      case Compaction::expanded:
        expand(s, packing, comm, settling);
        break;
      }
      wrap_into(packing.cell, packing.particles);
      measure_porosity(s, packing);
      return packing;
    }
    solid += packing.porosity - s.porosity;
  }
  throw InputError("cannot be reached: after " + std::to_string(max_draws) +
                   " draws the core has a porosity of " + std::to_string(packing.porosity) +
                   ", wanted " + std::to_string(s.porosity) +
                   "; enlarge the region or lower the upscaling ratio");
}

SizeReport describe_sizes(const Grading& wanted, const Particles& p)
{
  std::vector<double> d; // at S = 1; their mass is proportional to d^3
  for (const ParticleState& b : p.state) d.push_back(2.0 * b.R / b.S);
  std::sort(d.begin(), d.end());
  const auto n = static_cast<double>(d.size());
  double mass = 0.0;
  for (const double x : d) mass += x * x * x;
  SizeReport r;
  double sum = 0.0, number_below = 0.0, below = 0.0; // in the order of `mass`: ends at 1
  for (std::size_t k = 0; k < d.size();) {
    // The made curve is a step function, and the wanted one too where all sizes are equal:
    // they are compared just before and just behind a step. Equal diameters differ by round-off.
    constexpr double round_off = 1e-9;
    const double first = d[k];
    std::size_t end = k;
    for (; end < d.size() && d[end] <= first * (1.0 + round_off); ++end)
      sum += d[end] * d[end] * d[end];
    const double before = first * (1.0 - round_off),
                 behind = d[end - 1] * (1.0 + round_off);
    const double number = static_cast<double>(end) / n, share = sum / mass;
    const auto distance = [](double wanted_share, double made) {
      return std::abs(wanted_share - made);
    };
    r.distance_by_number =
        std::max({r.distance_by_number, distance(wanted.number_below(before), number_below),
                  distance(wanted.number_below(behind), number)});
    r.distance_by_mass =
        std::max({r.distance_by_mass, distance(wanted.passing(before), below),
                  distance(wanted.passing(behind), share)});
    const auto reach = [&](double of_mass, double& target) {
      if (below < of_mass && share >= of_mass) target = first;
    };
    reach(0.1, r.d_10);
    reach(0.5, r.d_50);
    reach(0.9, r.d_90);
    number_below = number;
    below = share;
    k = end;
  }
  return r;
}

ParticleRange describe_particles(const Particles& p)
{
  ParticleRange r;
  r.S_min = r.d_min = std::numeric_limits<double>::infinity();
  for (const ParticleState& b : p.state) {
    r.S_min = std::min(r.S_min, b.S);
    r.S_max = std::max(r.S_max, b.S);
    r.d_min = std::min(r.d_min, 2.0 * b.R);
    r.d_max = std::max(r.d_max, 2.0 * b.R);
  }
  return r;
}

} // namespace mergel::dem
