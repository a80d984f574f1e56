/// The specimen of a case: read from a file or made, with its report.
#pragma once

#include "apps/case/specimen_keys.h"
#include "apps/run/summary.h"

namespace mergel::apps {

/// Read the sample that the case names and compare its recipe, or make one, and draw the
/// strengths of its particles; collective. Nothing is written.
/// @throws InputError naming file, line and key
dem::Sample obtain_sample(const CaseFile& file, const SpecimenKeys& k);

/// One paragraph: porosity, pressure, coordination and sizes reached.
std::string report(const SpecimenKeys& k, const dem::Sample& sample);

/// The same as numbers, for summary.json.
Summary summary(const SpecimenKeys& k, const dem::Sample& sample);

} // namespace mergel::apps
