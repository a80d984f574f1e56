#include "dem/assembly/mass_scaling.h"

#include "dem/assembly/block_bound.h"
#include "dem/assembly/step.h"
#include "dem/text.h"

#include <algorithm>
#include <cstdio>

namespace mergel::dem {

namespace {

/// Smallest, middle and largest S; the middle may be empty.
std::vector<ScaledZone> zones_of(const Particles& p)
{
  double smallest = p.state.front().S, largest = smallest;
  for (const ParticleState& b : p.state) {
    smallest = std::min(smallest, b.S);
    largest = std::max(largest, b.S);
  }
  std::vector<ScaledZone> zones{{smallest, smallest}};
  if (largest > smallest) {
    zones.push_back({smallest, largest});
    zones.push_back({largest, largest});
  }
  return zones;
}

ScaledZone& zone_of(std::vector<ScaledZone>& zones, double S)
{
  if (S == zones.front().S_from) return zones.front();
  return S == zones.back().S_to ? zones.back() : zones[1];
}

std::string percent(double share)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
  return text;
}

std::string name_of(const ScaledZone& z)
{
  return z.S_from == z.S_to ? "S = " + shortest(z.S_from)
                            : "S from " + shortest(z.S_from) + " to " + shortest(z.S_to);
}

/// Of the mass of a particle.
struct Factor {
  Index particle;
  double value;
};

/// All others get their true mass.
void set_mass_factors(Particles& p, const std::vector<Factor>& factors)
{
  for (Index i = 0; i < p.size(); ++i) p.state[i].m = true_mass(p, i);
  p.mass_factor.assign(p.size(), 1.0);
  for (const Factor& f : factors) {
    p.mass_factor[f.particle] = f.value;
    p.state[f.particle].m *= f.value;
  }
}

} // namespace

std::vector<ScaledZone> scaled_zones(const Particles& p)
{
  if (p.mass_factor.empty()) return {};
  std::vector<ScaledZone> zones = zones_of(p);
  for (Index i = 0; i < p.size(); ++i) {
    ScaledZone& zone = zone_of(zones, p.state[i].S);
    ++zone.n;
    zone.n_scaled += p.mass_factor[i] > 1.0;
    zone.mass += true_mass(p, i);
    zone.added += p.state[i].m - true_mass(p, i);
  }
  std::erase_if(zones, [](const ScaledZone& z) { return z.n == 0; });
  return zones;
}

void scale_masses(Assembly& assembly, const MassScalingSpec& spec)
{
  Particles& p = assembly.particles;
  if (spec.gain <= 1.0 || p.size() == 0) return;
  complete_lists(assembly, open_gap_counted(assembly));
  const std::vector<double> bounds = block_bounds(assembly, linear_springs(assembly, {}));
  const double allowed =
      assembly.comm.global_max(*std::max_element(bounds.begin(), bounds.end())) /
      (spec.gain * spec.gain); // [1/s^2]

  std::vector<Factor> mine;
  p.for_owned([&](Index i) {
    if (bounds[i] > allowed) mine.push_back({i, bounds[i] / allowed});
  });
  set_mass_factors(p, assembly.comm.gather(mine));
  for (const ScaledZone& z : scaled_zones(p))
    if (z.share() > spec.largest_share)
      throw InputError("Motion/mass scaling = " + shortest(spec.gain) + ": it would add " +
                       percent(z.share()) + " to the mass of the particles with " +
                       name_of(z) + ": at most " + percent(spec.largest_share) +
                       "; lower it, or raise `Motion/mass scaling limit`");
}

void equalise_frequencies(Assembly& assembly, const Springs& springs, double omega2)
{
  Particles& p = assembly.particles;
  const std::vector<double> bounds = block_bounds(assembly, springs);
  std::vector<Factor> mine;
  p.for_owned([&](Index i) {
    const double now = p.mass_factor.empty() ? 1.0 : p.mass_factor[i];
    if (bounds[i] > 0.0) mine.push_back({i, now * bounds[i] / omega2});
  });
  set_mass_factors(p, assembly.comm.gather(mine));
}

void restore_masses(Assembly& assembly)
{
  Particles& p = assembly.particles;
  set_mass_factors(p, {});
  p.mass_factor.clear();
  for (ParticleState& b : p.state) {
    b.v.setZero();
    b.omega.setZero();
  }
}

ScaledZone sum_of(const std::vector<ScaledZone>& zones)
{
  ScaledZone all;
  for (const ScaledZone& z : zones) {
    all.n += z.n;
    all.n_scaled += z.n_scaled;
    all.mass += z.mass;
    all.added += z.added;
  }
  return all;
}

std::string report(const std::vector<ScaledZone>& zones)
{
  std::string text;
  const auto line = [&](const std::string& name, const ScaledZone& z) {
    text += "mass scaling, " + name + ": " + std::to_string(z.n_scaled) + " of " +
            std::to_string(z.n) + " particles, mass + " + percent(z.share()) + '\n';
  };
  if (zones.size() > 1)
    for (const ScaledZone& z : zones) line(name_of(z), z);
  if (!zones.empty()) line("all", sum_of(zones));
  return text;
}

} // namespace mergel::dem
