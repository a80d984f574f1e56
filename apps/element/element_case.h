/// Case of `mergel element`: a rock, the legs it is led along, and how they are read.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/material_keys.h"
#include "apps/case/specimen_keys.h"
#include "apps/element/loading_stages.h"
#include "apps/run/checkpoint_scheduler.h"
#include "dem/assembly/averages.h"
#include "dem/element/element_analysis.h"

namespace mergel::apps {

/// Strengths as a function of the width of the sample, Eqs. 17-19.
struct SizeEffect {
  bool is_on = false;
  double width = 0.0;             ///< B [m]; 0: the edge of the cell
  double reference_width = 50e-3; ///< [m]
  double psi = 1.1;               ///< of any width but the reference's [-]

  /// Factor of all strengths: psi (B_ref/B)^0.18; 1 at the reference width, which a width
  /// is that differs by less than 1 %: a cell that was confined is a little off its edge.
  double factor(double B) const;
};

struct ElementCase {
  SpecimenKeys specimen; ///< of a periodic box
  BondKeys bond;
  dem::LinearMaterial contact;
  SizeEffect size_effect;

  // Loading
  std::vector<std::string> leg_texts;
  std::vector<dem::Leg> legs;
  double inertial_number = 5e-4;
  double reference_pressure = 1e6; ///< [Pa]
  double strain_limit = 0.5;       ///< of the test [-]
  double reversal = 0.5;           ///< of the way made towards a goal [-]

  // Motion
  double damping = 0.7, safety = 0.7;
  bool free_rotation = false;

  // Analysis
  double secant_from = 1e-4, secant_to = 1e-3; ///< strain [-]
  double yield_offset = 2e-4;                  ///< strain [-]
  std::string critical_text;
  std::vector<dem::CriticalState> critical_states; ///< last states of other runs

  // Output
  enum class Pictures { none, legs, strain };
  double record_every = 2e-4; ///< strain [-]
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

/// Grains of a periodic cell and what is bonded.
struct ElementRock {
  dem::Particles particles;
  dem::PeriodicCell cell;
  std::vector<dem::Pair> bonded;
};
/// Collective. @throws InputError naming file, line and key
ElementRock obtain_rock(const CaseFile& file, const ElementCase& c);

/// B of the size effect [m]: its key, or the mean edge of the cell.
double sample_width(const ElementCase& c, const ElementRock& rock);

/// Margin of the lists at S = 1 [m], 0.3 of the smallest grain.
double list_skin(const dem::Particles& p);

/// The materials of the run: the keys' values at S = 1, with the size effect applied to the
/// strengths. Upscaling (Eq. 8) is the grains' own: a pair takes u_c and g_a times its S.
dem::PairMaterials resolved_materials(const ElementCase& c, const ElementRock& rock);

/// What was resolved, in words.
std::string report(const ElementCase& c, const ElementRock& rock,
                   const dem::PairMaterials& materials);

} // namespace mergel::apps
