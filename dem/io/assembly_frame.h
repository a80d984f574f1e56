/// One frame of an assembly for ParaView, the same of every job: its particles, bonds and contacts
/// (dem/README.md, Output).
#pragma once

#include "dem/continuum/loaded_branches.h"
#include "dem/io/vtk.h"

namespace mergel::dem {

/// What is borrowed must outlive the frame.
struct AssemblyFrame {
  const Assembly& assembly;                  ///< gathered: all particles
  const std::vector<Vec3>& x_0;              ///< displacements count from here [m]
  const std::vector<LoadedBranch>& branches; ///< of loaded_branches()
  std::vector<double> porosity; ///< around each particle, for its stress [-], below 1
  std::vector<Field> more;      ///< further fields of the particles
};

struct AssemblyFiles {
  std::filesystem::path particles, bonds, contacts;
};

/// Particles by write_particles() with three fields more, and those of `more`:
///   stress [Pa]         of neighbourhood_stresses(): xx, yy, zz, xy, yz, xz, tension positive
///   strain rate [1/s]   symmetric part of velocity_gradients(), the same, extension positive
///   coordination [-]
/// Bonds by write_bonds(), contacts by write_contacts(). Not collective.
/// @throws as the writers of dem/io/vtk.h
void write_frame(const AssemblyFiles& files, const AssemblyFrame& frame);

} // namespace mergel::dem
