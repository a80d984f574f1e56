/// What every job on a coupled rock reads from its case file: specimen, bond, contact, far
/// field, motion.
#pragma once

#include "apps/case/specimen_keys.h"
#include "fem/far_field/far_field.h"

#include <optional>

namespace mergel::apps {

/// What stands around the DEM region.
enum class FarFieldModel {
  elastic, ///< deal.II solid that moves with the rock
  rigid    ///< the same walls, held
};

/// How the interface holds the particles next to it.
enum class InterfaceBond {
  bonded,    ///< does not break
  breakable, ///< follows the bond law
  frictional ///< contact only
};

/// The DEM region is a half cylinder inside the far field.
struct RockCase : SpecimenKeys {
  BondKeys bond;
  dem::PairMaterials material; ///< its bond is set by complete()

  // Far field
  FarFieldModel model = FarFieldModel::elastic;
  fem::FarFieldSpec far_field;
  dem::LinearMaterial interface;
  InterfaceBond interface_bond = InterfaceBond::bonded;
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
void complete(CaseFile& file, RockCase& c);

} // namespace mergel::apps
