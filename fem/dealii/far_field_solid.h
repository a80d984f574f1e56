/// The far field on its mesh.
#pragma once

#include "fem/far_field/far_field_solid.h"

namespace mergel::fem {

/// Meshes and assembles. @pre spec.check() holds
std::unique_ptr<FarFieldSolid> make_far_field_solid(const FarFieldSpec& spec);

} // namespace mergel::fem
