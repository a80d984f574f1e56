/// E and nu of a rock, as an element test has measured them.
#pragma once

#include <filesystem>

namespace mergel::apps {

struct MeasuredElasticity {
  double E = 0.0;  ///< Young's modulus [Pa]
  double nu = 0.0; ///< Poisson's ratio [-]
};

/// Those of the first stage in `folder`/summary.json that has both: of compression or
/// triaxial.
/// @throws InputError when the folder is one of another job, when there is no such file, or no
///   such stage in it
MeasuredElasticity measured_elasticity(const std::filesystem::path& folder);

} // namespace mergel::apps
