/// Averages over a periodic cell of particles: stress, stiffness, fabric, porosity.
///
/// All sums are exact: the same bits on any number of ranks. Collective, unless a function
/// says otherwise. Theory: dem/README.md, Element tests.
#pragma once

#include "dem/assembly/step.h"

#include <vector>

namespace mergel::dem {

/// Averages over a cell that is periodic along all axes.
struct CellAverages {
  /// Love (1927), Weber (1966): 1/V sum F (x) r over the pairs, F on i, r from i to j; its
  /// symmetric part, tension positive [Pa].
  Mat3 stress = Mat3::Zero();
  /// Norm of the antisymmetric part of that sum over the norm of the symmetric part [-].
  double antisymmetric = 0.0;
  /// Normal traction on the planes through the origin that bound the cell, from the pairs
  /// that reach across them, tension positive [Pa]. Equals the diagonal of `stress` in
  /// equilibrium: the difference is the moment of the unbalanced forces.
  Vec3 traction = Vec3::Zero();
  Mat3 bond_fabric = Mat3::Zero();    ///< mean n (x) n of intact bonds, trace 1; 0 without
  Mat3 contact_fabric = Mat3::Zero(); ///< the same of contacts with a normal force
  double bond_coordination = 0.0;     ///< 2 N_bonds/N, intact bonds [-]
  double contact_coordination = 0.0;  ///< 2 N_contacts/N, contacts with a normal force [-]
  double porosity = 0.0;   ///< by sphere volumes; overlapping volume counts twice [-]
  double void_ratio = 0.0; ///< volume of voids over that of spheres [-]
};
CellAverages cell_averages(const Assembly& assembly);

/// Stress of a specimen between two heights [Pa], tension positive, symmetric part: Love's sum
/// F (x) r over all branches, from centre to centre and from a centre to the point of a
/// triangulated wall, each with the share of its height between z_low and z_high, divided by
/// area times height. Collective.
/// @param area of the cross-section [m^2]
Mat3 slab_stress(const Assembly& assembly, double z_low, double z_high, double area);

/// Stress of a box with edges along the axes [Pa], tension positive, symmetric part: Love's sum
/// over all branches from centre to centre, each with its share inside the box, divided by
/// `volume` [m^3]: what the box has of the specimen. Walls are left out. Collective.
Mat3 box_stress(const Assembly& assembly, const Vec3& low, const Vec3& high, double volume);

/// Stiffness of the cell along its edges if every particle followed the strain [Pa]:
/// 1/V sum L^2 [k_n n_a^4 + k_s n_a^2 (1 - n_a^2)] with the bonds' stiffness times 1 - D.
/// Voigt's upper bound of the stiffness without lateral strain: particles do not follow the
/// strain exactly.
Vec3 affine_stiffness(const Assembly& assembly);
/// The same of a specimen of this volume V [m^3] that is no cell; without its walls.
Vec3 affine_stiffness(const Assembly& assembly, double V);

/// Inertial number rate d sqrt(rho/p) [-]: time in which the pressure p moves a particle
/// into a void, over the time of the strain. Below 1e-3 the motion is quasi-static. Source:
/// GDR MiDi (2004), Eur. Phys. J. E 14, 341.
double inertial_number(double rate, double d, double rho, double p);

} // namespace mergel::dem
