/// The assembly around a pile as a continuum, at one frame.
#pragma once

#include "dem/assembly/local_strain.h"
#include "dem/continuum/section_sums.h"
#include "dem/io/vtk.h"

#include <filesystem>

namespace mergel::apps {

/// What the continuum fields of one frame are made of.
struct FrameInput {
  const dem::Assembly& assembly; ///< motions of all particles are up to date
  /// Positions of all particles at the start, at the last frame [m].
  const std::vector<dem::Vec3>&x_0, &x_last;
};

/// Size of the half cylinder of particles, and of the averaging windows [m].
struct ContinuumSpec {
  double radius = 0.0, depth = 0.0, above = 0.0; ///< above: height of the grid over z = 0
  double averaging_length = 0.0;                 ///< edge of a square window
  double layer = 0.0;                            ///< thickness of the coloured layers
};

/// Windows of three by three cells of a section grid: their edge is the averaging length. Each rank
/// has the branches and fields of its own particles, and after add_ranks() all sums.
class PileContinuum {
public:
  static constexpr int reach = 1; ///< of a window, in cells to each side

  /// Not collective. @param frame must outlive the object
  /// @throws NumericalError for a particle inside the pile
  PileContinuum(const ContinuumSpec& spec, const FrameInput& frame);
  /// Add the sums of the other ranks; collective.
  void add_ranks() { sums_.add_ranks(frame_.assembly.comm); }

  const dem::SectionSums& sums() const { return sums_; }
  const std::vector<dem::LoadedBranch>& branches() const { return branches_; }
  /// Of the window around each owned particle, below 1 [-].
  std::vector<double> porosity() const;
  /// Fields of the owned particles that other jobs lack (apps/pile/README.md, Results).
  std::vector<dem::Field> particle_fields() const;
  void write_section(const std::filesystem::path& file) const;

private:
  const FrameInput& frame_;
  ContinuumSpec spec_;
  std::vector<dem::LoadedBranch> branches_;
  std::vector<dem::DeformationFit> fits_; ///< since the last frame
  dem::ParticleValues values_;
  dem::SectionSums sums_;
};

} // namespace mergel::apps
