/// Section `Specimen` of a case: shape, grain sizes, upscaling, density of packing and
/// bonding; with it how strengths vary. The same in every job that makes a specimen.
#pragma once

#include "apps/case/material_keys.h"
#include "apps/case/strength_keys.h"
#include "dem/io/sample_file.h"

namespace mergel::apps {

/// What holds the half model at its symmetry plane.
enum class Symmetry {
  mirror, ///< each particle near the plane is bonded to its image: the plane carries tension
  wall    ///< images act by their contact only
};

struct SpecimenKeys {
  enum class Shape { half_cylinder, cylinder, periodic_box };
  enum class Sizes { uniform, power, log_normal, table };
  enum class Upscaling { graded, uniform };

  Shape shape = Shape::half_cylinder;
  double diameter = unset, height = unset;      ///< of a cylinder or half of one [m]
  int faces = 48;                               ///< around the side of a cylinder
  dem::Vec3 edges = dem::Vec3::Constant(unset); ///< of a periodic box [m]

  Sizes sizes = Sizes::uniform;
  double d_min = unset, d_max = unset; ///< at S = 1 [m]
  double exponent = 0.5;               ///< of a power law [-]
  double d_50 = unset, spread = unset; ///< of a log-normal law [m], [-]
  std::filesystem::path table;         ///< of a sieve curve
  std::string table_sum;               ///< of its bytes; empty: as it is found

  Upscaling upscaling = Upscaling::graded;
  double S = unset; ///< the same everywhere

  dem::SpecimenSpec specimen; ///< region, sizes and contact are set by complete()
  Symmetry symmetry = Symmetry::mirror;
  std::filesystem::path sample;       ///< empty: make the specimen
  dem::StrengthVariability strengths; ///< drawn by each run: no part of a sample's recipe
};

/// Declare the keys; defaults of the choices are those that `k` holds.
void declare(CaseFile& file, SpecimenKeys& k);

/// Fill k.specimen from the keys and this far-field contact, and check it. The sides of a half
/// cylinder are the far field's, which has no mesh yet: two of them, enough for the checks.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, SpecimenKeys& k, const dem::LinearMaterial& contact);

/// Key and value of everything that fixes a specimen, in a fixed order.
std::vector<std::pair<std::string, std::string>> recipe(const SpecimenKeys& k);

} // namespace mergel::apps
