/// The legs of an element test as a case file writes them, one a key:
///
///     set leg 1 = isotropic to p = 1 MPa
///     set leg 2 = triaxial to axial strain = 2 %
///     set leg 3 = unload-reload to q = 0.2 MPa
///     set leg 4 = resume to axial strain = 15 %
///     set leg 5 = axes x = fixed, y = 0.5 MPa, z = driven to axial strain = 20 %
#pragma once

#include "dem/element/stress_path.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// The forms that a leg may have, a line each; for the help.
extern const char* const forms_of_leg;

/// Legs of one key: one, or two of unload-reload.
/// @throws InputError saying what is wrong and what is expected; it does not repeat the text
std::vector<dem::Leg> read_legs(const std::string& text);

/// "isotropic to p = 1 MPa"; for logs.
std::string name_of(const dem::Leg& leg);

} // namespace mergel::apps
