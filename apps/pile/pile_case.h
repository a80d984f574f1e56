/// Case of `mergel pile`: coupled system, pile and output.
#pragma once

#include "apps/case/coupled_case.h"
#include "apps/pile/pile_stages.h"
#include "apps/pile/pile_surface.h"
#include "apps/run/checkpoint_scheduler.h"
#include "coupling/driven_pile.h"

#include <map>

namespace mergel::apps {

struct PileCase {
  CoupledCase assembly;

  // Pile
  enum class Tip { cone, flat, surface } tip = Tip::cone;
  double diameter = unset;    ///< [m]; of a surface, of the circle of its largest section
  double cone_angle = unset;  ///< full angle at the tip [rad]; unset without a cone
  PileSurface surface;        ///< with a polyhedron where `tip = surface`
  double velocity = unset;    ///< downwards [m/s]
  double final_depth = unset; ///< of the shoulder below the surface [m]; unset with stages
  double mass = unset;        ///< of the full pile [kg]; unset without stages
  double contact_modulus = unset; ///< [Pa]
  double friction = unset;        ///< [-]
  dem::ContactLaw contact;        ///< with the particles; set by complete()

  // Loading; all but the stages unset with a final depth
  std::map<std::size_t, std::string> stage_texts; ///< by number, from 1
  std::vector<PileStage> stages;                  ///< set by complete(); at least one
  double displacement_rate = unset;               ///< of pull and push [m/s]
  double force_ramp = unset;         ///< time in which a head force changes [s]
  double balance_tolerance = unset;  ///< unbalanced-force ratio of a stage [-]
  double largest_settlement = unset; ///< under a head force [m]

  // Output
  double record_every = unset;   ///< travel between lines of history.csv [m]
  int frames = 20;               ///< frames of the fields after the first
  double averaging_length = 2.0; ///< of the continuum fields, in d50 beside the pile [-]
  CheckpointKey checkpoints;

  double tip_height() const; ///< from the lowest point to the shaft [m]; 0 for a flat tip
  bool has_stages() const { return !stage_texts.empty(); } ///< else one final depth
  /// Depth of the tip with the shoulder at the depth of this stage, a penetration [m].
  double tip_at_end(const PileStage& stage) const { return stage.target + tip_height(); }
  /// The same of the first stage: of the final depth, without stages [m].
  double travel() const { return tip_at_end(stages.front()); }
  /// Largest depth of the shoulder that a stage asks for [m].
  double deepest() const;
  /// How much of the pile, and of its forces, is modelled [-].
  double modelled_share() const { return assembly.is_half() ? 0.5 : 1.0; }
  /// Of that part.
  coupling::PileInertia inertia() const;
};

/// "stage 1" for k = 0.
std::string key_of_pile_stage(std::size_t k);

void declare(CaseFile& file, PileCase& c);

/// @throws InputError naming file, line and key
void complete(CaseFile& file, PileCase& c);

} // namespace mergel::apps
