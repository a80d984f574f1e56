#include "apps/case/motion_keys.h"

namespace mergel::apps {

void declare(CaseFile& file, const MotionKeys& keys)
{
  using Rule = dem::StepRule;
  file.choice("time step", keys.step.rule,
              std::vector<std::pair<std::string, Rule>>{{"eigenvalue", Rule::eigenvalue},
                                                        {"block bound", Rule::block_bound}},
              "Stable step from the largest frequency of all that acts, or from a bound of "
              "it, which is smaller and takes no iteration unless a structure moves.");
  file.derived("time step safety", keys.step.safety, "1",
               above_to(0.0, dem::largest_safety), "0.9, or 0.98 of the block bound",
               "Time step over the stable step. Beyond 1 the run goes unstable, which its "
               "energy error shows.");
  file.flag("free rotation", keys.free_rotation,
            "Let particles without an intact bond rotate; in the paper they do not.");
  file.number("inertia factor", keys.inertia_factor, between(0.1, 100.0),
              "Moments of inertia in the equations of motion over the true ones. Where "
              "rotation rules the step, more of it lengthens the step. Compare with 1: 2 "
              "raises the q_c of pile_small by a tenth.");
  file.number(
      "mass scaling", keys.mass_scaling.gain, between(1.0, 10.0),
      "Wanted gain of the time step: the few particles that rule it get mass and "
      "moment of inertia, but no weight. 1: none. Compare with 1: 1.5 raises the q_c "
      "of pile_small by a tenth, 1.26 within its scatter.");
  file.number("mass scaling limit", keys.mass_scaling.largest_share, non_negative,
              "Largest share of mass that the particles of one zone of S may gain.");
  file.number("largest overlap", keys.largest_overlap, above_to(0.0, 1.0),
              "Overlap of two particles over the smaller radius at which the run stops; a "
              "restart may change it.");
}

void complete(CaseFile& file, const MotionKeys& keys)
{
  file.derive("Motion", "time step safety",
              keys.step.rule == dem::StepRule::eigenvalue ? dem::default_safety
                                                          : dem::default_block_safety);
}

} // namespace mergel::apps
