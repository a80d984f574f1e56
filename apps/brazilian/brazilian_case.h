/// Case of `mergel brazilian`: specimen, materials, plates, loading.
#pragma once

#include "apps/case/material_keys.h"
#include "apps/case/specimen_keys.h"
#include "apps/run/checkpoint_scheduler.h"
#include "coupling/brazilian/brazilian_test.h"

namespace mergel::apps {

/// Section `Plates`.
struct PlateKeys {
  double contact_modulus = unset; ///< with the particles [Pa]
  double friction = 0.0;          ///< [-]
};

struct BrazilianCase : coupling::BrazilianControl {
  BrazilianCase();

  SpecimenKeys specimen; ///< of a cylinder: the disc
  BondKeys bond;
  ContactKeys contact;
  PlateKeys plates;

  // Motion
  double damping = dem::default_damping;
  bool free_rotation = false;
  dem::StepSpec step;
  double inertia_factor = 1.0;
  double largest_overlap = dem::Motion{}.largest_overlap; ///< over the smaller radius [-]
  dem::MassScalingSpec mass_scaling;

  // Set by complete()
  dem::PairMaterials material;
  dem::ContactLaw plate_contact;

  // Output
  enum class Pictures { none, ends, strain };
  Pictures pictures = Pictures::strain;
  double picture_every = 1e-3; ///< diametral strain [-]
  CheckpointKey checkpoints;

  coupling::DiscGeometry disc() const { return {specimen.diameter, specimen.height}; }
};

void declare(CaseFile& file, BrazilianCase& c);

/// Set what follows from the keys, and check conditions on several of them.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, BrazilianCase& c);

coupling::CoupledSpec coupled_spec(const BrazilianCase& c);

} // namespace mergel::apps
