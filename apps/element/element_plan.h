/// What a case of mergel element would run, and what is unusual of it.
#pragma once

#include "apps/element/element_case.h"
#include "apps/run/plan.h"

namespace mergel::apps {

/// Inertial number, specimen and materials. @pre the case is complete
Remarks unusual(const ElementCase& c);

Plan plan_of(const CaseFile& file, const ElementCase& c);

/// Say of each folder of `Analysis/critical states` that is there why its last state is no
/// critical one, by the rule of mergel compare (apps/compare/README.md, Lines).
void remark_on_critical_states(Remarks& remarks,
                               const std::vector<std::filesystem::path>& folders);

/// Stages whose strain is beyond the limit of the test.
/// @param labels of all stages
void remark_on_stages(Remarks& remarks, const std::vector<dem::LoadingStage>& stages,
                      const std::vector<StageLabel>& labels, double limit);

/// Many stages where each has frames of its own.
void remark_on_frames(Remarks& remarks, const std::vector<dem::LoadingStage>& stages);

/// Strain that a test covers [-], every stage counted: strains to their targets, stresses by a
/// modulus, a reloading as much as its unloading.
/// @param modulus of the specimen [Pa] @param limit of a strain [-]
double strain_of_stages(const std::vector<dem::LoadingStage>& stages, double modulus,
                        double limit);

/// Axial stiffness of a specimen whose particles follow the strain, for estimates [Pa]:
///   M = 3 (1 - n) Z/(pi d) (k_n/5 + 2 k_s/15),   bonds and contacts of particles of mean volume.
double estimated_modulus(const SpecimenKeys& k, const dem::PairMaterials& material);

} // namespace mergel::apps
