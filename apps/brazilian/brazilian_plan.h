/// What a case of mergel brazilian would run, and what is unusual of it.
#pragma once

#include "apps/brazilian/brazilian_case.h"
#include "apps/run/plan.h"

namespace mergel::apps {

/// Velocity of the plates, specimen and materials. @pre the case is complete
Remarks unusual(const BrazilianCase& c);

Plan plan_of(const CaseFile& file, const BrazilianCase& c);

} // namespace mergel::apps
