/// Case of `mergel element`: a rock, the legs it is led along, and how they are read.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/material_keys.h"
#include "apps/case/specimen_keys.h"
#include "apps/element/loading_stages.h"
#include "apps/run/checkpoint_scheduler.h"
#include "dem/element/element_analysis.h"
#include "dem/element/element_test.h"
#include "dem/laws/size_effect.h"

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
  dem::LinearMaterial contact;
  SizeEffectKeys size_effect;

  // Loading
  std::vector<std::string> leg_texts;

  // Analysis
  double secant_from = 1e-4, secant_to = 1e-3; ///< strain [-]
  double yield_offset = 2e-4;                  ///< strain [-]
  std::string critical_text;
  std::vector<dem::CriticalState> critical_states; ///< last states of other runs

  // Output
  enum class Pictures { none, legs, strain };
  Pictures pictures = Pictures::legs;
  double picture_every = 1e-2; ///< strain [-]
  CheckpointKey checkpoints;
};

constexpr std::size_t most_legs = 12;
/// "leg 1" of 0.
std::string key_of_leg(std::size_t k);

void declare(CaseFile& file, ElementCase& c);

/// Checks that span keys; reads the legs.
void complete(CaseFile& file, ElementCase& c);

/// Collective. @throws InputError naming file, line and key
dem::PeriodicSpecimen obtain_rock(const CaseFile& file, const ElementCase& c);

/// B of the size effect [m]: its key, or the mean edge of the cell.
double sample_width(const ElementCase& c, const dem::PeriodicSpecimen& rock);

/// The materials of the run: the keys' values at S = 1, with the size effect applied to the
/// strengths. Upscaling (Eq. 8) is the grains' own: a pair takes u_c and g_a times its S.
dem::PairMaterials resolved_materials(const ElementCase& c,
                                      const dem::PeriodicSpecimen& rock);

/// What was resolved, in words.
std::string report(const ElementCase& c, const dem::PeriodicSpecimen& rock,
                   const dem::PairMaterials& materials);

} // namespace mergel::apps
