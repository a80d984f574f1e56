/// Case of `mergel triaxial`: specimen, materials, membrane, platens, loading stages.
#pragma once

#include "apps/case/material_keys.h"
#include "apps/case/specimen_keys.h"
#include "apps/element/loading_stages.h"
#include "apps/element/stage_analysis.h"
#include "apps/run/checkpoint_scheduler.h"
#include "coupling/triaxial/triaxial_test.h"

namespace mergel::apps {

/// Section `Membrane`.
struct MembraneKeys {
  bool is_there = true;
  fem::MembraneMaterial material{unset, 0.3e-3, 1000.0, fem::Compression::wrinkles};
  double node_distance = unset; ///< [m]
  coupling::MembraneEnds ends = coupling::MembraneEnds::free;
  double contact_modulus = unset, friction = 0.0; ///< with the particles [Pa], [-]
  int largest_subcycle = 1;
};

/// Section `Platens`.
struct PlatenKeys {
  enum class Seat { fixed, spherical };
  Seat seat = Seat::fixed;                          ///< of the upper one
  double mass = unset;                              ///< of a platen that tilts [kg]
  double contact_modulus = unset, friction = unset; ///< with the particles [Pa], [-]
};

struct TriaxialCase : coupling::TriaxialControl {
  SpecimenKeys specimen; ///< of a cylinder
  BondKeys bond;
  ContactKeys contact;
  MembraneKeys membrane;
  PlatenKeys platens;
  StageTexts stage_texts;
  std::vector<StageLabel> stage_labels; ///< of all stages; set by complete()

  // Set by complete()
  dem::PairMaterials material;
  fem::Tube tube;
  dem::ContactLaw membrane_contact, platen_contact;

  AnalysisKeys analysis;

  // Output
  enum class Pictures { none, stages, strain };
  Pictures pictures = Pictures::stages;
  double picture_every = 1e-2;      ///< strain [-]
  double localisation_every = 1e-2; ///< strain [-]
  CheckpointKey checkpoints;

  double d_50() const { return specimen.specimen.sizes.sieve(0.5) * specimen.S; } ///< [m]
  /// The largest cell pressure that the stages name, or under which particles without bonds
  /// begin [Pa]; 0 without any.
  double largest_pressure() const;
};

void declare(CaseFile& file, TriaxialCase& c);

/// Set what follows from the keys, and check conditions on several of them.
/// @throws InputError naming file, line and key
void complete(CaseFile& file, TriaxialCase& c);

/// The specimen before the test. @param porosity of its core
coupling::SpecimenGeometry geometry_of(const TriaxialCase& c, double porosity);

coupling::CoupledSpec coupled_spec(const TriaxialCase& c);

/// Lower platen, upper platen and, unless there is none, the membrane. Collective.
std::vector<coupling::StructureSpec> structures(const TriaxialCase& c, MPI_Comm comm);

} // namespace mergel::apps
