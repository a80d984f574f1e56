/// Continuum fields for ParaView: averages on a section grid, stresses of particles, force chains
/// (dem/README.md, Output).
#pragma once

#include "dem/continuum/section_sums.h"
#include "dem/io/grid_file.h"

namespace mergel::dem {

/// The averages over square windows around the middles of the cells, each a point of a grid in
/// the plane y = 0. Components are those of the section: x, y, z. NaN where there is no rock.
///
///   stress [Pa]                     xx, yy, zz, xy, yz, xz, tension positive
///   p [Pa], q [Pa]                  compression positive
///   major, intermediate, minor principal stress [Pa]    compression positive
///   major principal direction [-]   unit vector
///   porosity [-], damage [-], coordination [-]
///   displacement [m], displacement increment [m]        3 components
///   volumetric strain of the increment [-] (compression positive), shear strain of the
///   increment [-]
///
/// @param reach of a window, in cells to each side of its middle one
void write_section(const std::filesystem::path& file, const SectionSums& sums, int reach);

/// A symmetric tensor of each particle: xx, yy, zz, xy, yz, xz.
Field tensor_field(const std::string& name, const std::vector<Mat3>& tensors);
Field vector_field(const std::string& name, const std::vector<Vec3>& vectors);

/// Force chains: lines along the branches that bear a load, with "normal force [N]" (compression
/// positive) and "shear force [N]" (its size), net of bond and contact. A branch to a wall ends on
/// the wall, one to a mirror image on the plane y = 0, one through a face of a periodic cell at the
/// centre of the image.
void write_contacts(const std::filesystem::path& file, const Particles& p,
                    const std::vector<LoadedBranch>& branches);

} // namespace mergel::dem
