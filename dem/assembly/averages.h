/// What a periodic cell of grains is as a continuum: stress, stiffness, fabric, porosity.
///
/// All sums are exact: the same bits on any number of ranks. Collective.
#pragma once

#include "dem/assembly/step.h"

#include <vector>

namespace mergel::dem {

/// Means over a cell that is periodic in all axes.
struct CellAverages {
  /// Love (1927), Weber (1966): 1/V sum F (x) r over the pairs, F on i, r from i to j; its
  /// symmetric part, tension positive [Pa].
  Mat3 stress = Mat3::Zero();
  double skew = 0.0; ///< norm of its skew part over that of the symmetric one [-]
  /// Normal traction on the planes through the origin that bound the cell, from the pairs
  /// that reach across them, tension positive [Pa]. Equals the diagonal of `stress` in
  /// equilibrium: the difference is the moment of the unbalanced forces.
  Vec3 traction = Vec3::Zero();
  Mat3 bond_fabric = Mat3::Zero();    ///< mean n (x) n of living bonds, trace 1; 0 without
  Mat3 contact_fabric = Mat3::Zero(); ///< the same of contacts that press
  double bond_coordination = 0.0;     ///< 2 N_bonds/N, living bonds [-]
  double contact_coordination = 0.0;  ///< 2 N_contacts/N, pairs whose contact presses [-]
  double porosity = 0.0; ///< by true sphere volumes; what spheres overlap counts twice [-]
  double void_ratio = 0.0; ///< volume of voids over that of spheres [-]
};
CellAverages cell_averages(const Rock& rock);

/// Stress of each grain of a rock that this rank holds whole [Pa]: Love's sum F (x) (x_c - x_i)
/// over its contacts, F on the grain, over its share v/(1 - n) of the cell, v the sphere; its
/// symmetric part, tension positive. Weighed with the shares they make up the stress of the
/// cell. Walls and mirror images are left out. Not collective.
std::vector<Mat3> grain_stresses(const Rock& rock);

/// Stiffness of the cell along its edges if every grain followed the strain [Pa]:
/// 1/V sum L^2 [k_n n_a^4 + k_s n_a^2 (1 - n_a^2)] with the bonds' stiffness times 1 - D.
/// The grains yield, so this bounds the stiffness of the cell held sideways (Voigt).
Vec3 affine_stiffness(const Rock& rock);

/// rate d sqrt(rho/p) [-]: time that pressure needs to move a grain into a void, over that
/// of the strain. Below 1e-3 the motion is quasi-static. Source: GDR MiDi (2004), Eur. Phys. J.
/// E 14, 341.
double inertial_number(double rate, double d, double rho, double p);

} // namespace mergel::dem
