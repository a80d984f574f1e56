#include "apps/triaxial/triaxial_plan.h"

#include "apps/element/element_plan.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

Remarks unusual(const TriaxialCase& c)
{
  Remarks remarks;
  remark_on_stages(remarks, c.stages, c.stage_labels, c.strain_limit);
  if (c.pictures == TriaxialCase::Pictures::stages) remark_on_frames(remarks, c.stages);
  expect_at_most(remarks, "Loading/inertial number", c.inertial_number, quasi_static,
                 "the test is not quasi-static");
  remark_on_specimen(remarks, c.specimen);
  remark_on_granular(remarks, c.specimen);
  remark_on_motion(remarks, c.contact, c.damping);
  if (c.specimen.is_granular()) return remarks;
  remark_on_materials(remarks, c.bond, c.contact);
  remark_on_bonds(remarks, c.bond, c.specimen);
  return remarks;
}

Plan plan_of(const CaseFile& file, const TriaxialCase& c)
{
  Plan plan =
      plan_of_specimen(file, c.specimen, c.material, c.step.safety, c.inertia_factor);
  plan.unusual = unusual(c);
  if (!c.specimen.is_granular()) plan.cost = cost_of_test;
  if (c.membrane.is_there)
    plan.step_overhead = seconds_of_triangle * 2.0 * c.tube.n_around * c.tube.n_high;
  const dem::SpecimenSpec& s = c.specimen.specimen;
  const double E = estimated_modulus(c.specimen, c.material);
  // v of each platen sends a wave of rho c v = v sqrt(E rho)
  const double v = c.wave_stress / std::sqrt(E * s.rho * (1.0 - s.porosity));
  const double by_inertia =
      c.inertial_number / (c.d_50() * std::sqrt(s.rho / c.reference_pressure));
  const double rate = std::min(2.0 * v / c.specimen.height, by_inertia);
  plan.n_steps = strain_of_stages(c.stages, E, c.strain_limit) / (rate * plan.step);
  plan.steps_by = "strain of all stages over step and rate, the rate by `wave stress` or "
                  "`inertial number`, of a specimen that follows the strain";
  return plan;
}

Plan plan_triaxial(const JobOptions& options)
{
  return plan_case<TriaxialCase>(options);
}

} // namespace mergel::apps
