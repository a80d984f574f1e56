/// Local strain: the deformation gradient that best fits how the neighbours of a particle,
/// or any set of particles, moved between two configurations (dem/README.md, Element tests).
///
/// Plain arithmetic on the positions of all particles: not collective. Source: Falk and Langer
/// (1998), Phys. Rev. E 57, 7192.
#pragma once

#include "dem/particles/cell.h"
#include "dem/particles/particles.h"

#include <cstddef>
#include <vector>

namespace mergel::dem {

/// Least-squares fit of the vectors from a centre to n particles, D_j in the reference
/// configuration and d_j in the present one:
///
///   F = (sum d_j D_j^T) (sum D_j D_j^T)^-1     minimises sum |d_j - F D_j|^2
///
/// Fewer than four particles, or D_j that lie in a plane within some 1/1000 of their
/// length, do not determine F. It is the identity then, D2_min = 0 and n = 0: a field of
/// fits has no NaN.
struct DeformationFit {
  Mat3 F = Mat3::Identity(); ///< deformation gradient, rotation included [-]
  /// What remains over the distances in the reference, both as mean squares:
  /// sum |d_j - F D_j|^2 / sum |D_j|^2 [-], >= 0; 0 where the motion is affine. Falk and
  /// Langer take the sum |d_j - F D_j|^2 itself, which grows with size and number.
  double D2_min = 0.0;
  std::size_t n = 0; ///< particles fitted; 0 where they do not determine F
};

/// Largest distance of neighbours in the reference over R_i + R_j [-]. The first shell of a
/// random packing ends there, at the minimum of the pair distribution. A periodic packing
/// at porosity 0.52 with diameters of 1 to 2 has 12 neighbours a particle, at the smallest
/// 6, and 97 % of the particles have 8 or more.
inline constexpr double neighbour_reach = 1.5;

/// Fit of each particle to its neighbours, about its own centre. Neighbours are those with
/// |X_j - X_i| < neighbour_reach (R_i + R_j), however far they are now. The cost is linear
/// in the number of particles (find_pairs()).
///
/// At a boundary all neighbours are on one side. A neighbour that is far away now, such as
/// debris, dominates the fit; D2_min is large there.
/// @param X, x reference and present positions [m], never wrapped
/// @param R radii [m], > 0
/// @param cell_0, cell in the reference and at present, periodic along the same axes
/// @throws InputError when a periodic edge of cell_0 is shorter than 4 neighbour_reach
///   times the largest radius
/// @throws std::logic_error when X, x and R differ in number
std::vector<DeformationFit> local_deformations(const std::vector<Vec3>& X,
                                               const std::vector<Vec3>& x,
                                               const std::vector<double>& R,
                                               const PeriodicCell& cell_0 = {},
                                               const PeriodicCell& cell = {});

/// The same of the owned particles, in their order; of the others only the positions count.
/// @param X reference positions of all particles [m]; the present ones in p are up to date
std::vector<DeformationFit> local_deformations(const std::vector<Vec3>& X,
                                               const Particles& p,
                                               const PeriodicCell& cell_0 = {},
                                               const PeriodicCell& cell = {});

/// Velocity gradient L of each particle at this moment [1/s]: it minimises
/// sum |v_j - v_i - L (x_j - x_i)|^2 over the neighbours within neighbour_reach now. In a strained
/// cell, whose velocities are relative to it, its rate is added. Where the neighbours do not
/// determine L, or the cell is too narrow for neighbourhoods (neighbourhood.h), it is that of the
/// cell, 0 without one.
/// @param x positions [m], v velocities [m/s], R radii [m], > 0
/// @throws std::logic_error when x, v and R differ in number
std::vector<Mat3> velocity_gradients(const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                                     const std::vector<double>& R,
                                     const PeriodicCell& cell = {});

/// Fit of the particles `indices` about their centroid. No periodic images: the positions
/// are taken as they are.
/// @param X, x reference and present positions of all particles [m]
/// @throws std::out_of_range when there is no such particle
DeformationFit deformation_of(const std::vector<Vec3>& X, const std::vector<Vec3>& x,
                              const std::vector<Index>& indices);

/// Volumetric strain 1 - det F [-]: loss of volume over the volume in the reference,
/// compression positive as in soil mechanics.
double volumetric_strain(const Mat3& F);

/// Shear strain eps_q = sqrt(2/3 dev(E) : dev(E)) [-], >= 0, of the Green-Lagrange strain
/// E = 1/2 (F^T F - I), which a rotation leaves as it is. Small strains: 2/3 |eps_a -
/// eps_r| in triaxial compression, gamma/sqrt(3) in simple shear.
double shear_strain(const Mat3& F);

} // namespace mergel::dem
