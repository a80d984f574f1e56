/// The rock as ParaView sees it.
#pragma once

#include "dem/assembly/step.h"
#include "dem/io/vtk.h"

namespace mergel::dem {

/// Points with radius [m], velocity [m/s], damage (mean over the bonds that the particle
/// was given; 0 without) [-], force (resultant of contacts and bonds, without gravity) [N], S
/// [-], id, displacement from x_0 [m] and, where they vary, the factor of bond strengths [-]; then
/// `more`.
void write_particles(const std::filesystem::path& file, const Rock& rock,
                     const std::vector<Vec3>& x_0, const std::vector<Field>& more = {});

/// Lines between particles that were ever bonded, with N (tension positive) [N], V [N], M
/// [N m] and D. A bond through a periodic face ends at the image of its second particle.
void write_bonds(const std::filesystem::path& file, const Rock& rock);

/// The half of the pile at y >= 0, up to z_top [m].
void write_pile(const std::filesystem::path& file, const Pile& pile, double z_top);

/// Mean damage of the bonds that each particle was given.
std::vector<double> particle_damage(const Rock& rock);

} // namespace mergel::dem
