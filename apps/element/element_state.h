/// The state of an element test and what it has recorded, as named arrays, and back.
#pragma once

#include "apps/element/element_case.h"
#include "dem/element/element_test.h"
#include "dem/io/state/state_file.h"

namespace mergel::apps {

/// Each rank its part. Collective.
void put(dem::State& state, const dem::ElementState& s);
/// @throws InputError when the state is of another case
dem::ElementState take_element(dem::State& state, const ElementCase& c);

/// What was recorded so far, for the analysis of the legs.
void put(dem::State& state, const std::vector<dem::ElementRecord>& records);
std::vector<dem::ElementRecord> take_records(const dem::State& state);

} // namespace mergel::apps
