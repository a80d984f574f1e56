/// Bands of localised strain in the specimen of a triaxial test (coupling/README.md, Triaxial
/// test): which slab holds the most sheared and the most compacted particles.
#pragma once

#include "dem/assembly/assembly.h"
#include "dem/assembly/local_strain.h"
#include "dem/assembly/localisation.h"
#include "dem/io/state/named_numbers.h"

#include <cstddef>
#include <vector>

namespace mergel::coupling {

/// Bands at one time. Total strains count from the start of the test. Increments show what
/// strains now: a band that is no longer active is in the total alone.
struct BandRecord {
  double time = 0.0;         ///< [s]
  std::size_t stage = 0;     ///< from 0
  double axial_strain = 0.0; ///< of the platens, from the start of the test [-]
  double increment = 0.0; ///< of the axial strain, over which the increments are taken [-]
  dem::Localisation shear, shear_increment;           ///< of the shear strain
  dem::Localisation compaction, compaction_increment; ///< of the volumetric strain
};
void save(dem::State& state, const std::vector<BandRecord>& records);
std::vector<BandRecord> load_band_records(const dem::State& state);

/// Local strain of each particle: of a rank's own particles in their order, or of all.
struct LocalStrains {
  std::vector<dem::DeformationFit> total;     ///< from the start of the test
  std::vector<dem::DeformationFit> increment; ///< from an earlier time of the stage
};

/// Earlier positions of the particles, from which increments are taken: the last two, `every` of
/// axial strain apart, or those at the start of the stage. An increment reaches back to the last
/// that is at least half of `every` away, so over half of it to one and a half. Plain data, the
/// same on every rank.
class EarlierPositions {
public:
  /// @param every [-], > 0
  EarlierPositions(double every, double axial_strain, std::vector<dem::Vec3> x);
  /// From the numbers of save(). @throws InputError when they are of another assembly
  EarlierPositions(double every, const dem::State& state, std::size_t n_particles);

  /// Forget all before a stage.
  void begin_stage(double axial_strain, std::vector<dem::Vec3> x);
  /// Whether the axial strain is `every` away from the last positions.
  bool is_due(double axial_strain) const;
  /// Add these as the last.
  void add(double axial_strain, std::vector<dem::Vec3> x);

  /// Those from which an increment is taken at this axial strain.
  const std::vector<dem::Vec3>& x(double axial_strain) const;
  /// The axial strain since [-], >= 0.
  double increment(double axial_strain) const;

  void save(dem::State& state) const;

private:
  struct Positions {
    double axial_strain = 0.0;
    std::vector<dem::Vec3> x;
  };
  const Positions& reference(double axial_strain) const;

  double every_;
  Positions older_, newer_;
};

/// Of the owned particles; the positions of all are up to date.
/// @param x_0 positions of all particles at the start of the test
LocalStrains local_strains(const std::vector<dem::Vec3>& x_0,
                           const std::vector<dem::Vec3>& earlier, const dem::Particles& p);
/// Those of all particles on the first rank, nothing on the others; collective.
LocalStrains gather_on_first_rank(const LocalStrains& mine, const dem::Assembly& assembly);

/// The four localisations, from the strains of all particles. Time, stage and axial strain are
/// the caller's.
/// @param x present positions, in which bands are looked for
BandRecord find_bands(const std::vector<dem::Vec3>& x, const LocalStrains& strains,
                      double d_50);

} // namespace mergel::coupling
