/// What every job with a coupled system reads from its case file: specimen, bond, contact,
/// far field, motion.
#pragma once

#include "apps/case/measured_elasticity.h"
#include "apps/case/specimen_keys.h"
#include "coupling/far_field_structure.h"
#include "dem/assembly/mass_scaling.h"
#include "dem/assembly/timestep.h"

#include <optional>

namespace mergel::apps {

/// How the interface holds the particles next to it.
enum class InterfaceBond {
  bonded,    ///< does not break
  breakable, ///< follows the bond law
  frictional ///< contact only
};

/// The DEM region is a half cylinder inside a half of the far field, or a cylinder inside all
/// of it (coupling/README.md, Far field).
struct CoupledCase : SpecimenKeys {
  BondKeys bond;
  ContactKeys contact;
  dem::PairMaterials material; ///< set by complete()

  // Far field
  coupling::FarFieldStructure::Model model = coupling::FarFieldStructure::Model::elastic;
  fem::FarFieldSpec far_field;
  std::filesystem::path
      elasticity_from; ///< results folder of an element test; may be empty
  std::optional<MeasuredElasticity> rock; ///< read there by complete()
  double side_pressure = unset;      ///< on the chamber wall [Pa]; unset where that is held
  double surcharge = 0.0;            ///< on the surface of particles and far field [Pa]
  double interface_modulus = unset;  ///< [Pa]
  double interface_friction = unset; ///< [-]
  dem::ContactLaw interface;         ///< set by complete()
  InterfaceBond interface_bond = InterfaceBond::bonded;
  double collar_height = unset; ///< [m]
  int largest_subcycle = 4; ///< of the far field: steps from kick to kick by its own forces

  // Motion
  double gravity = dem::standard_gravity; ///< [m/s^2], downwards
  double damping = dem::default_damping;
  bool free_rotation = false;
  dem::StepSpec step;
  double inertia_factor = 1.0;
  double largest_overlap = dem::Motion{}.largest_overlap; ///< over the smaller radius [-]
  dem::MassScalingSpec mass_scaling;
  double unbalanced_tolerance = 1e-4; ///< unbalanced-force ratio of an equilibrium [-]

  bool is_half() const { return shape == Shape::half_cylinder; }
};

/// Declare the keys of `Specimen`, `Bond`, `Contact`, `Far field` and `Motion`.
void declare(CaseFile& file, CoupledCase& c);

/// Set what follows from the keys, and check conditions on several of them.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, CoupledCase& c);

} // namespace mergel::apps
