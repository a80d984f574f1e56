/// Case of `mergel element`: specimen, materials, loading stages and their analysis.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/material_keys.h"
#include "apps/case/specimen_keys.h"
#include "apps/element/loading_stages.h"
#include "apps/element/stage_analysis.h"
#include "apps/run/checkpoint_scheduler.h"
#include "dem/element/element_analysis.h"
#include "dem/element/element_test.h"
#include "dem/laws/size_effect.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mergel::apps {

/// Section `Size effect`.
struct SizeEffectKeys {
  bool is_on = false;
  double width = 0.0; ///< B [m]; 0: the edge of the cell
  dem::SizeEffect law;

  double factor(double B) const { return is_on ? law.factor(B) : 1.0; }
};

struct ElementCase : dem::ElementControl {
  SpecimenKeys specimen; ///< of a periodic box
  BondKeys bond;
  ContactKeys contact;
  SizeEffectKeys size_effect;

  // Loading
  StageTexts stage_texts;
  std::vector<StageLabel> stage_labels; ///< of all stages; set by complete()

  // Analysis
  AnalysisKeys analysis;
  std::vector<std::filesystem::path> critical_folders;
  std::string critical_values; ///< the states below by their folders, for the resolved case
  std::vector<dem::CriticalState> critical_states; ///< final states of the runs in them

  // Output
  enum class Pictures { none, stages, strain };
  Pictures pictures = Pictures::stages;
  double picture_every = 1e-2; ///< strain [-]
  CheckpointKey checkpoints;
};

void declare(CaseFile& file, ElementCase& c);

/// Reads the stages and checks conditions on several keys.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, ElementCase& c);

/// Specimen of the case, read or made. Collective.
/// @throws InputError naming file, line and key
dem::PeriodicSpecimen obtain_specimen(const CaseFile& file, const ElementCase& c);

/// Width B of the size effect [m]: its key, or the mean edge of the cell.
double specimen_width(const ElementCase& c, const dem::PeriodicSpecimen& specimen);

/// The materials of the run at S = 1, with the size effect applied to the strengths. The
/// upscaling (Eq. 8) is not in them: a pair multiplies u_c and g_a by its S.
dem::PairMaterials resolved_materials(const ElementCase& c,
                                      const dem::PeriodicSpecimen& specimen);

/// Text on the specimen and the resolved materials.
std::string report(const ElementCase& c, const dem::PeriodicSpecimen& specimen,
                   const dem::PairMaterials& materials);

} // namespace mergel::apps
