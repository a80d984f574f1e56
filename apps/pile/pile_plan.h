/// What a case of mergel pile would run, and what is unusual of it.
#pragma once

#include "apps/pile/pile_case.h"
#include "apps/run/plan.h"

namespace mergel::apps {

/// D_p/d50, chamber/D_p, penetration rate, specimen and materials. @pre the case is complete
Remarks unusual(const PileCase& c);

Plan plan_of(const CaseFile& file, const PileCase& c);

} // namespace mergel::apps
