/// Saving and loading an element test and its records: each number by its
/// name.
#pragma once

#include "apps/element/element_case.h"
#include "dem/element/element_test.h"
#include "dem/io/state/state_file.h"

namespace mergel::apps {

/// Add the state of the test, each rank its part. Collective.
void save(dem::State& state, const dem::ElementState& s);
/// @throws InputError when the state is of another case
dem::ElementState load_element(dem::State& state, const ElementCase& c);

/// Add the records so far, for the analysis of the stages.
void save(dem::State& state, const std::vector<dem::ElementRecord>& records);
/// @throws InputError when there is none
std::vector<dem::ElementRecord> load_records(const dem::State& state);

} // namespace mergel::apps
