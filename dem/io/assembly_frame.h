/// One frame of an assembly for ParaView, the same of every job: its particles, bonds and contacts
/// (dem/README.md, Output).
#pragma once

#include "dem/continuum/loaded_branches.h"
#include "dem/io/assembly_fields.h"

namespace mergel::dem {

/// What a rank knows of a frame. What is borrowed must outlive the frame.
struct AssemblyFrame {
  const Assembly& assembly; ///< motions of all particles are up to date (gather_motion())
  const std::vector<Vec3>& x_0; ///< of all particles: displacements count from here [m]
  const std::vector<LoadedBranch>& branches; ///< of loaded_branches()
  std::vector<double> porosity; ///< around each owned particle, for its stress [-], below 1
  std::vector<Field> more;      ///< further fields of the owned particles
};

struct AssemblyFiles {
  std::filesystem::path particles, bonds, contacts;
};

/// The files of a frame, each on the rank that writes it: particles on the first, bonds on the
/// second, contacts on the third, or on the last where there are fewer. Every rank computes the
/// fields of its own particles and bonds.
///
/// Particles have the fields of particle_fields(), three fields more, and those of `more`:
///   stress [Pa]         of neighbourhood_stresses(): xx, yy, zz, xy, yz, xz, tension positive
///   strain rate [1/s]   symmetric part of velocity_gradients(), the same, extension positive
///   coordination [-]
/// Bonds are those of write_bonds(), contacts those of write_contacts().
class FrameFiles {
public:
  /// Collective.
  explicit FrameFiles(AssemblyFrame frame);

  /// Write those of this rank. Not collective.
  /// @throws as the writers of dem/io/vtk.h
  void write(const AssemblyFiles& files) const;

private:
  const Assembly& assembly_;
  int bonds_on_, contacts_on_; ///< ranks
  std::vector<Field> particles_;
  std::vector<BondLine> bonds_;
  std::vector<LoadedBranch> contacts_;
};

} // namespace mergel::dem
