/// Sections `Specimen` (shape, sizes, upscaling, packing, bonding) and `Strength
/// variability` of a case. The same in every job that makes a specimen.
#pragma once

#include "apps/case/material_keys.h"
#include "apps/case/strength_keys.h"
#include "dem/io/sample_file.h"

namespace mergel::apps {

/// What supports the half model at its symmetry plane.
enum class Symmetry {
  mirror, ///< particles near the plane are bonded to their images: it carries tension
  wall    ///< particles and their images are in contact only
};

struct SpecimenKeys {
  enum class Shape { half_cylinder, cylinder, periodic_box };
  enum class Sizes { uniform, power, log_normal, table };
  enum class Upscaling { graded, uniform };

  Shape shape = Shape::half_cylinder;
  double diameter = unset, height = unset; ///< of a cylinder or half cylinder [m]
  int faces = 48;                          ///< plane faces of the side of a cylinder
  bool is_side_meshed = false; ///< they are those of a far field: there is no key for them
  dem::Vec3 edges = dem::Vec3::Constant(unset); ///< of a periodic box [m]

  Sizes sizes = Sizes::uniform;
  double d_min = unset, d_max = unset; ///< at S = 1 [m]
  double exponent = 0.5;               ///< of a power law [-]
  double d_50 = unset, spread = unset; ///< of a log-normal law [m], [-]
  std::filesystem::path table;         ///< of a sieve curve
  std::string table_sum;               ///< its checksum; empty: not checked
  std::string table_points;            ///< its content; empty: the file is read

  Upscaling upscaling = Upscaling::graded;
  double S = unset; ///< the same everywhere

  dem::SpecimenSpec specimen; ///< region, sizes and contact are set by complete()
  Symmetry symmetry = Symmetry::mirror;
  std::filesystem::path sample;       ///< empty: make the specimen
  dem::StrengthVariability strengths; ///< drawn by each run; not part of the recipe

  /// Without bonds: particles in contact alone.
  bool is_granular() const { return specimen.coordination == 0.0; }
};

/// Declare the keys. The defaults of the choices are the values in `k`.
void declare(CaseFile& file, SpecimenKeys& k);

/// Set k.specimen from the keys and this far-field contact, and check it. The side of a
/// half cylinder gets two faces here, enough for the checks; make_far_field() sets the number
/// of a meshed side.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, SpecimenKeys& k, const dem::ContactLaw& contact);

/// Key and value of everything that determines a specimen, in a fixed order.
std::vector<std::pair<std::string, std::string>> recipe(const SpecimenKeys& k);

} // namespace mergel::apps
