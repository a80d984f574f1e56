#include "apps/run/plan.h"

#include "dem/error.h"
#include "dem/specimen/forecast.h"

#include <algorithm>

namespace mergel::apps {

namespace {

constexpr double bytes_of_program = 0.20e9, bytes_of_cell = 11e3;
/// Of a particle: 2.2 kB with 2.0 bonds, 3.2 kB with 2.9; fewer bonds have not been measured.
constexpr double bytes_of_bond = 1.1e3, fewest_bonds = 2.0;
constexpr double most_steps = 1e9, most_hours = 720.0;

} // namespace

Plan plan_of_specimen(const CaseFile& file, const SpecimenKeys& k,
                      const dem::PairMaterials& material, double step_safety,
                      double inertia_factor)
{
  Plan plan;
  plan.n_particles = dem::expected_particles(k.specimen);
  plan.particles_by = "solid volume over the mean volume of a particle";
  plan.bonds_per_particle = 0.5 * k.specimen.coordination;
  plan.is_made = k.sample.empty();
  if (!k.sample.empty()) {
    try {
      const dem::Sample sample = dem::read_sample(k.sample);
      plan.n_particles = static_cast<double>(sample.packing.particles.size());
      plan.bonds_per_particle =
          static_cast<double>(sample.bonding.pairs.size()) / plan.n_particles;
      plan.particles_by = "those of " + k.sample.string();
    } catch (const InputError& e) {
      file.refuse("Specimen", "file", e.what());
    }
  }
  plan.step =
      step_safety * dem::estimated_stable_step(k.specimen, material, inertia_factor);
  return plan;
}

void remark_on_length(Plan& plan)
{
  const std::string why = "is a rate too small, or a unit wrong?";
  expect_at_most(plan.unusual, "number of steps", plan.n_steps, most_steps, why);
  expect_at_most(plan.unusual, "hours on one rank",
                 time_of(plan, plan.cost, 1).all() / 3600.0, most_hours, why);
}

double memory_of(const Plan& plan)
{
  const double particles =
      plan.n_particles * bytes_of_bond * std::max(fewest_bonds, plan.bonds_per_particle);
  return bytes_of_program + std::max(bytes_of_cell * plan.n_cells, particles);
}

RunTime time_of(const Plan& plan, double cost, int n_ranks)
{
  const double of_step = 1e-9 * cost * plan.n_particles / n_ranks + plan.step_overhead;
  return {seconds_to_start,
          plan.is_made ? seconds_to_make * plan.n_particles / n_ranks : 0.0,
          plan.n_steps * of_step};
}

} // namespace mergel::apps
