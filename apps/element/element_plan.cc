#include "apps/element/element_plan.h"

#include "apps/laboratory/test_reading.h"
#include "dem/error.h"
#include "dem/specimen/forecast.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

void remark_on_stages(Remarks& remarks, const std::vector<dem::LoadingStage>& stages,
                      const std::vector<StageLabel>& labels, double limit)
{
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const bool is_repeated = labels[k].cycle > 1;
    if (!stages[k].returns && !is_repeated && dem::is_strain(stages[k].quantity))
      expect_at_most(remarks,
                     "strain of stage " + labels[k].name() + ", `" + labels[k].text + "`",
                     std::abs(stages[k].target), limit,
                     "the test ends before, at `Loading/strain limit`");
  }
}

void remark_on_frames(Remarks& remarks, const std::vector<dem::LoadingStage>& stages)
{
  expect_at_most(
      remarks, "number of stages, each cycle two", static_cast<double>(stages.size()),
      100.0,
      "each has a frame of its own and a line of the summary; frames by strain alone: "
      "`Output/pictures = strain`");
}

void remark_on_critical_states(Remarks& remarks,
                               const std::vector<std::filesystem::path>& folders)
{
  for (const std::filesystem::path& folder : folders) {
    std::error_code error; // a folder that cannot be reached counts as gone
    if (!std::filesystem::exists(folder, error)) continue; // its state is in the case
    const std::string of = "Analysis/critical states: " + folder.string() + ": ";
    try {
      const std::string why = read_test(folder, "").not_critical;
      if (!why.empty()) remarks.push_back(of + "no critical state: " + why);
    } catch (const InputError& e) {
      remarks.push_back(of + "nobody knows whether it is a critical state: " + e.what());
    }
  }
}

Remarks unusual(const ElementCase& c)
{
  Remarks remarks;
  remark_on_critical_states(remarks, c.critical_folders);
  remark_on_stages(remarks, c.stages, c.stage_labels, c.strain_limit);
  if (c.pictures == ElementCase::Pictures::stages) remark_on_frames(remarks, c.stages);
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

double strain_of_stages(const std::vector<dem::LoadingStage>& stages, double modulus,
                        double limit)
{
  struct End {
    double stress = 0.0, strain = 0.0;
  };
  double sum = 0.0, unloading = 0.0; // unloading: strain of the last stage
  End end, before; // where the last stage has ended, and the one before it
  for (const dem::LoadingStage& stage : stages) {
    const bool resumes = stage.kind == dem::PathKind::resume;
    if (stage.has_lateral) sum += std::abs(stage.lateral - end.stress) / modulus;
    if (stage.returns) { // what its unloading took, to where that began
      sum += unloading;
      end = before;
      continue;
    }
    before = end;
    if (dem::is_strain(stage.quantity)) {
      unloading = std::min(limit, std::abs(stage.target - (resumes ? end.strain : 0.0)));
      end.strain = stage.target;
    } else {
      unloading = std::min(limit, std::abs(stage.target - end.stress) / modulus);
      end.stress = stage.target;
    }
    sum += unloading;
  }
  return sum;
}

double estimated_modulus(const SpecimenKeys& k, const dem::PairMaterials& material)
{
  const dem::SpecimenSpec& s = k.specimen;
  const double d = std::cbrt(s.sizes.mean_cube()); // S = 1: k/d does not depend on the size
  dem::ContactStiffness<double> spring =
      dem::contact_stiffness(material.contact, dem::sides_of_pair(0.5 * d, 0.5 * d),
                             0.5 * dem::estimated_overlap * d);
  double Z = dem::granular_coordination;
  if (!k.is_granular()) {
    const auto bond = bond_shape(dem::section(material.bond), 0.5 * d, 1.0 / d);
    spring.k_n += bond.k_n;
    spring.k_s += bond.k_s;
    Z = s.coordination;
  }
  return 3.0 * (1.0 - s.porosity) * Z / (dem::pi * d) *
         (spring.k_n / 5.0 + 2.0 * spring.k_s / 15.0);
}

Plan plan_of(const CaseFile& file, const ElementCase& c)
{
  const dem::PairMaterials material{
      c.specimen.is_granular() ? dem::BondLaw{} : c.bond.chosen(), c.contact.chosen()};
  Plan plan = plan_of_specimen(file, c.specimen, material, c.step.safety, c.inertia_factor);
  plan.unusual = unusual(c);
  if (!c.specimen.is_granular()) plan.cost = cost_of_test;
  const double rate =
      c.inertial_number / (smallest_d_50(c.specimen) *
                           std::sqrt(c.specimen.specimen.rho / c.reference_pressure));
  plan.n_steps =
      strain_of_stages(c.stages, estimated_modulus(c.specimen, material), c.strain_limit) /
      (rate * plan.step);
  plan.steps_by =
      "strain of all stages over step and rate, the rate by `inertial number` at "
      "`reference pressure`: fewer steps where p is higher";
  return plan;
}

Plan plan_element(const JobOptions& options)
{
  return plan_case<ElementCase>(options);
}

} // namespace mergel::apps
