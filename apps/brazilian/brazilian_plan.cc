#include "apps/brazilian/brazilian_plan.h"

#include <cmath>

namespace mergel::apps {

Remarks unusual(const BrazilianCase& c)
{
  const dem::SpecimenSpec& s = c.specimen.specimen;
  const double p = std::visit(
      [](const auto& law) {
        const dem::BondShape<double> shape = bond_shape(law, 1.0, 1.0);
        return single_strengths(law, shape).tension / shape.A;
      },
      c.material.bond);
  Remarks remarks;
  expect_at_most(remarks, "inertial number v d50/D sqrt(rho/sigma_t)",
                 c.velocity / c.specimen.diameter * smallest_d_50(c.specimen) *
                     std::sqrt(s.rho / p),
                 quasi_static, "the test is not quasi-static; lower `Loading/velocity`");
  remark_on_specimen(remarks, c.specimen);
  remark_on_motion(remarks, c.contact, c.damping);
  remark_on_materials(remarks, c.bond, c.contact);
  remark_on_bonds(remarks, c.bond, c.specimen);
  return remarks;
}

Plan plan_of(const CaseFile& file, const BrazilianCase& c)
{
  Plan plan =
      plan_of_specimen(file, c.specimen, c.material, c.step.safety, c.inertia_factor);
  plan.unusual = unusual(c);
  plan.n_steps = c.strain_limit * c.specimen.diameter / (c.velocity * plan.step);
  plan.steps_by =
      "to `Loading/strain limit` at the velocity; the test ends earlier where the "
      "load falls";
  return plan;
}

Plan plan_brazilian(const JobOptions& options)
{
  return plan_case<BrazilianCase>(options);
}

} // namespace mergel::apps
