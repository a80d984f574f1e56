/// Saving and loading an element test, its outcomes and its records: each number by its
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

/// Add the outcomes of the stages that were begun.
void save(dem::State& state, const std::vector<dem::Outcome>& outcomes);
/// @throws InputError when there is none, or more than the stages of the case
std::vector<dem::Outcome> load_outcomes(const dem::State& state, std::size_t n_stages);

} // namespace mergel::apps
