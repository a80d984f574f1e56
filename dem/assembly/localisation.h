/// Localisation: the slab that holds the most strained particles, as a shear band or a
/// compaction band does (dem/README.md, Localisation).
///
/// Plain arithmetic on the positions of all particles, as a gathered assembly has them: not
/// collective, and the same bits wherever it is computed.
#pragma once

#include "dem/notation.h"

#include <vector>

namespace mergel::dem {

/// The space between two parallel planes, and what it holds of particles that carry weights.
struct Slab {
  Vec3 normal = Vec3::UnitZ(); ///< unit, z >= 0
  double from = 0.0, to = 0.0; ///< it holds x where from <= normal.x < to [m]
  double share = 0.0;          ///< of the weights, in it [-]
  double even = 0.0; ///< of the particles: what it would hold of weights spread evenly [-]

  double thickness() const { return to - from; } ///< [m]
  double excess() const { return share - even; } ///< [-], 0 to 1
  double angle() const;         ///< between the planes and the horizontal [rad]
  double dip_direction() const; ///< of the normal's horizontal part, from x towards y [rad]
  bool holds(const Vec3& x) const
  {
    const double t = normal.dot(x);
    return from <= t && t < to;
  }
};

/// Weight 1 for the `share` of the particles with the largest values, 0 for the others; of equal
/// values the first. @param share above 0, at most 1; the number is rounded up
std::vector<double> mark_largest(const std::vector<double>& values, double share);

/// The slab of the largest excess, over all normals and both faces: the mean weight is above that
/// of all particles inside, and below it outside. The share alone would be largest in a slab that
/// holds most of the specimen; the excess does not depend on the shape of the specimen. For one
/// normal and weights of 0 and 1 it is the statistic of Kuiper (1960), Proc. K. Ned. Akad. Wet.
/// A 63, 38, of the positions along the normal.
///
/// Normals are those of a grid of 4 degrees on the half sphere; the best four are refined to an
/// eighth of a degree. Faces lie on multiples of the resolution.
/// @param x positions [m]
/// @param weight of each particle, >= 0; the slab is empty where none is above 0
/// @param resolution of the faces [m], > 0
/// @throws NumericalError when the particles extend over more than a million resolutions
Slab find_slab(const std::vector<Vec3>& x, const std::vector<double>& weight,
               double resolution);

/// The same over slabs of this thickness [m]; its hundredth is the resolution.
Slab find_slab_of_thickness(const std::vector<Vec3>& x, const std::vector<double>& weight,
                            double thickness);

/// Where a strain is localised. The tenth are the tenth of the particles with the largest strain,
/// as far as it is above 0.
struct Localisation {
  /// The slab of the largest excess of the tenth. Inside it they are more than a tenth of the
  /// particles, which defines the thickness. Resolution d_50/20.
  Slab band;
  /// The slab of 10 d_50 of the largest excess of the tenth.
  Slab of_ten;
  /// As `band`, of the particles outside of it; its shares are those of the rest of the tenth and
  /// of the rest of the particles. Where two bands cross it is the second.
  Slab second;

  /// Share of all the tenth in the second slab [-].
  double of_second() const { return (1.0 - band.share) * second.share; }
  /// Whether the second slab holds much of the tenth: a fifth, and a quarter of the rest more
  /// than evenly spread. Of few marks the best slab has an excess without any band, up to
  /// 2/sqrt(n).
  bool has_second() const { return of_second() >= 0.2 && second.excess() >= 0.25; }
};

/// @param x present positions [m]
/// @param strain of each particle, compression positive: shear_strain(), or volumetric_strain()
///   for a compaction band
/// @param d_50 [m], > 0
Localisation localise(const std::vector<Vec3>& x, const std::vector<double>& strain,
                      double d_50);

/// Inclinations of a shear band to the plane of the major principal stress, here the
/// horizontal [rad].
struct BandAngles {
  double coulomb; ///< pi/4 + phi/2
  double roscoe;  ///< pi/4 + psi/2, Roscoe (1970), Geotechnique 20, 129
  double arthur;  ///< their mean, Arthur et al. (1977), Geotechnique 27, 53
};
/// @param phi, psi mobilised friction angle and dilation angle [rad]
BandAngles band_angles(double phi, double psi);

/// Dilation angle psi in triaxial compression [rad]: sin psi = -r/(2 - r), with r the increment of
/// the volumetric strain over that of the axial strain, compression positive. Vermeer and de
/// Borst (1984), Heron 29 (3). Where |sin psi| would exceed 1 psi is a right angle.
double dilation_angle(double r);

} // namespace mergel::dem
