/// Fields of an assembly for ParaView (dem/README.md, Output).
#pragma once

#include "dem/assembly/local_strain.h"
#include "dem/assembly/step.h"
#include "dem/io/vtk.h"

namespace mergel::dem {

/// Fields of the owned particles, in their order: radius [m], velocity [m/s], damage (mean over
/// the particle's bonds, broken ones included; 0 without bonds) [-], force (resultant of contacts
/// and bonds, without gravity) [N], S [-], id, displacement from x_0 [m] and, if strengths vary,
/// the factor of the bond strengths [-].
/// @param x_0 of all particles [m]
std::vector<Field> particle_fields(const Assembly& assembly, const std::vector<Vec3>& x_0);

/// "volumetric strain [-]" (compression positive), "shear strain [-]" and "D2_min [-]" of
/// each particle; all 0 where the neighbours do not determine them.
std::vector<Field> strain_fields(const std::vector<DeformationFit>& fits);

/// A pair that was ever bonded, and its bond.
struct BondLine {
  Pair pair;
  BondReading bond;
};
/// All pairs that were ever bonded, ascending, on the rank `to`; nothing on the others. Collective.
std::vector<BondLine> gather_bonds(const Assembly& assembly, int to);

/// Lines between particles that were ever bonded, with N (tension positive) [N], V [N], M
/// [N m], T [N m] and D. A bond through a periodic face ends at the image of its second particle.
/// @param p with the positions of all particles; @param bonds of gather_bonds()
void write_bonds(const std::filesystem::path& file, const Particles& p,
                 const PeriodicCell& cell, const std::vector<BondLine>& bonds);

/// A body of revolution at x, rotated about x, up to z_top [m] where it stands upright: its half
/// at y >= 0 and the face that cuts it.
void write_half_revolution(const std::filesystem::path& file, const Revolution& shape,
                           const Vec3& x, const Eigen::Quaterniond& rotation, double z_top);
/// The whole of it.
void write_revolution(const std::filesystem::path& file, const Revolution& shape,
                      const Vec3& x, const Eigen::Quaterniond& rotation, double z_top);

/// Mean damage of the bonds of each owned particle, broken ones included [-].
std::vector<double> particle_damage(const Assembly& assembly);

} // namespace mergel::dem
