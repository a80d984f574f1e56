/// The loading stages of an element test as written in a case file, one per key:
///
///     set stage 1 = isotropic to p = 1 MPa
///     set stage 2 = triaxial to axial strain = 2 %
///     set stage 3 = unload-reload to q = 0.2 MPa
///     set stage 4 = resume to axial strain = 15 %
///     set stage 5 = axes x = fixed, y = 1 MPa, z = strain-controlled to axial strain = 2 %
#pragma once

#include "dem/element/stress_path.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// The forms that a stage may have, for help and messages.
extern const char* const forms_of_stage;

/// Stages of one key: one, or two for unload-reload.
/// @throws InputError with the error and the expected form; it does not repeat the text
std::vector<dem::LoadingStage> read_stages(const std::string& text);

/// "isotropic to p = 1 MPa"; for logs.
std::string name_of(const dem::LoadingStage& stage);

} // namespace mergel::apps
