/// What a case of mergel triaxial would run, and what is unusual of it.
#pragma once

#include "apps/run/plan.h"
#include "apps/triaxial/triaxial_case.h"

namespace mergel::apps {

/// Inertial number, specimen and materials. @pre the case is complete
Remarks unusual(const TriaxialCase& c);

Plan plan_of(const CaseFile& file, const TriaxialCase& c);

} // namespace mergel::apps
