/// Fields of an assembly for ParaView (dem/README.md, Output).
#pragma once

#include "dem/assembly/local_strain.h"
#include "dem/assembly/step.h"
#include "dem/io/vtk.h"

namespace mergel::dem {

/// Particles as points with radius [m], velocity [m/s], damage (mean over the particle's
/// bonds, broken ones included; 0 without bonds) [-], force (resultant of contacts and
/// bonds, without gravity) [N], S [-], id, displacement from x_0 [m] and, if strengths
/// vary, the factor of the bond strengths [-]; then the fields of `more`.
void write_particles(const std::filesystem::path& file, const Assembly& assembly,
                     const std::vector<Vec3>& x_0, const std::vector<Field>& more = {});

/// "volumetric strain [-]" (compression positive), "shear strain [-]" and "D2_min [-]" of
/// each particle, for write_particles(); all 0 where the neighbours do not determine them.
std::vector<Field> strain_fields(const std::vector<DeformationFit>& fits);

/// Lines between particles that were ever bonded, with N (tension positive) [N], V [N], M
/// [N m] and D. A bond through a periodic face ends at the image of its second particle.
void write_bonds(const std::filesystem::path& file, const Assembly& assembly);

/// A body of revolution at x, rotated about x, up to z_top [m] where it stands upright: its half
/// at y >= 0 and the face that cuts it.
void write_half_revolution(const std::filesystem::path& file, const Revolution& shape,
                           const Vec3& x, const Eigen::Quaterniond& rotation, double z_top);
/// The whole of it.
void write_revolution(const std::filesystem::path& file, const Revolution& shape,
                      const Vec3& x, const Eigen::Quaterniond& rotation, double z_top);

/// Mean damage of the bonds of each particle, broken ones included [-].
std::vector<double> particle_damage(const Assembly& assembly);

} // namespace mergel::dem
