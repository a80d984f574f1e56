/// Section `Strength variability` of a case: how strengths vary from particle to particle.
#pragma once

#include "apps/case/case_file.h"
#include "dem/pairs/strength.h"

namespace mergel::apps {

/// Declare the section and its keys.
void declare(CaseFile& file, dem::StrengthVariability& v);

/// "" without variability, else a newline and one line on the strengths drawn.
std::string report(const dem::StrengthVariability& v, const dem::Particles& p);

} // namespace mergel::apps
