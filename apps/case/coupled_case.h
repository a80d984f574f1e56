/// What every job with a coupled system reads from its case file: specimen, bond, contact,
/// far field, motion.
#pragma once

#include "apps/case/specimen_keys.h"
#include "dem/assembly/timestep.h"
#include "fem/far_field/far_field.h"

#include <optional>

namespace mergel::apps {

/// What surrounds the DEM region.
enum class FarFieldModel {
  elastic, ///< elastic solid (finite elements) that moves with the assembly
  rigid    ///< the same walls, held fixed
};

/// How the interface holds the particles next to it.
enum class InterfaceBond {
  bonded,    ///< does not break
  breakable, ///< follows the bond law
  frictional ///< contact only
};

/// The DEM region is a half cylinder inside the far field (coupling/README.md, Interface).
struct CoupledCase : SpecimenKeys {
  BondKeys bond;
  dem::PairMaterials material; ///< its bond is set by complete()

  // Far field
  FarFieldModel model = FarFieldModel::elastic;
  fem::FarFieldSpec far_field;
  dem::LinearMaterial interface;
  InterfaceBond interface_bond = InterfaceBond::bonded;
  double collar_height = unset; ///< [m]

  // Motion
  double gravity = dem::standard_gravity; ///< [m/s^2], downwards
  double damping = dem::default_damping;
  double safety = dem::default_safety; ///< of the time step
  bool free_rotation = false;
  double unbalanced_tolerance = 1e-4; ///< unbalanced-force ratio of an equilibrium [-]
};

/// Declare the keys of `Specimen`, `Bond`, `Contact`, `Far field` and `Motion`.
void declare(CaseFile& file, CoupledCase& c);

/// Set what follows from the keys, and check conditions on several of them.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, CoupledCase& c);

} // namespace mergel::apps
