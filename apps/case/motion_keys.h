/// Keys of section `Motion` that every job with a particle assembly has.
#pragma once

#include "apps/case/case_file.h"
#include "dem/assembly/mass_scaling.h"
#include "dem/assembly/timestep.h"

namespace mergel::apps {

/// How particles move, and in which steps. Borrowed from the case.
struct MotionKeys {
  bool& free_rotation;
  dem::StepSpec& step;
  double& inertia_factor;
  dem::MassScalingSpec& mass_scaling;
  double& largest_overlap;
};

/// Those of a case, which has them under these names.
template <class Case>
MotionKeys motion_keys(Case& c)
{
  return {c.free_rotation, c.step, c.inertia_factor, c.mass_scaling, c.largest_overlap};
}

/// Declare them in the open section `Motion`.
void declare(CaseFile& file, const MotionKeys& keys);

/// Set the safety that follows from the rule of the step.
void complete(CaseFile& file, const MotionKeys& keys);

} // namespace mergel::apps
