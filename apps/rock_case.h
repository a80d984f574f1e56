/// What every job on a coupled rock reads from its case file: specimen, bond, contact, far
/// field, motion.
#pragma once

#include "apps/material_keys.h"
#include "dem/io/sample_file.h"
#include "dem/step.h"
#include "fem/far_field.h"

#include <optional>

namespace mergel::apps {

/// What stands around the DEM region.
enum class FarFieldModel {
  elastic, ///< deal.II solid that moves with the rock
  rigid    ///< the same walls, held
};

struct RockCase {
  // Specimen
  double diameter = unset, height = unset; ///< of the DEM region [m]
  dem::SpecimenSpec specimen;
  dem::Symmetry symmetry = dem::Symmetry::mirror;
  std::filesystem::path sample; ///< empty: make the specimen

  BondKeys bond;
  dem::PairMaterials material; ///< its bond is set by complete()

  // Far field
  FarFieldModel model = FarFieldModel::elastic;
  fem::FarFieldSpec far_field;
  dem::LinearMaterial interface;
  dem::InterfaceBond interface_bond = dem::InterfaceBond::bonded;
  double lip = 2e-3; ///< [m]

  // Motion
  double gravity = 9.81; ///< [m/s^2], downwards
  double damping = 0.7;
  double safety = 0.7; ///< of the time step
  bool free_rotation = false;
  double balance = 1e-4; ///< unbalanced-force ratio of an equilibrium [-]
};

/// Declare the keys of `Specimen`, `Bond`, `Contact`, `Far field` and `Motion`.
void declare(CaseFile& file, RockCase& c);

/// Fill what follows from the keys, and check what spans several of them.
/// @throws InputError naming file, line and key
void complete(const CaseFile& file, RockCase& c);

/// Key and value of everything that fixes a specimen, in a fixed order.
std::vector<std::pair<std::string, std::string>> recipe(const RockCase& c);

/// Read the sample that the case names and compare its recipe, or make one. Nothing is
/// written.
/// @throws InputError naming file, line and key
dem::Sample obtain_sample(const CaseFile& file, const RockCase& c);

/// One paragraph on what was reached.
std::string report(const RockCase& c, const dem::Sample& sample);

} // namespace mergel::apps
