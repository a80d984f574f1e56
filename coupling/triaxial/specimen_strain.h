/// Strain of the specimen itself: best-fit deformation gradient of the particles of its middle
/// third, away from platens and membrane (coupling/README.md, Triaxial test).
#pragma once

#include "dem/assembly/assembly.h"

namespace mergel::coupling {

/// Compression positive; engineering strains from the deformation gradient.
struct SpecimenStrain {
  double axial = 0.0, lateral = 0.0; ///< 1 - F_zz, 1 - the mean of F_xx and F_yy [-]
  double volumetric = 0.0;           ///< 1 - det F [-]
};

/// The particles whose reference position lies in the middle third of the height.
class MiddleThird {
public:
  MiddleThird() = default;
  /// @param x_0 reference positions by particle [m]; at least four in the third
  MiddleThird(const std::vector<dem::Vec3>& x_0, double z_bottom, double height);

  /// F minimises sum |x - mean x - F (X - mean X)|^2 (Falk and Langer 1998, Phys. Rev. E 57,
  /// 7192, with one set for all). Collective; the same bits on any number of ranks.
  SpecimenStrain strain(const dem::Assembly& assembly) const;

private:
  std::vector<dem::Index> members_;
  std::vector<dem::Vec3> X_;                  ///< of the members, less their mean [m]
  dem::Mat3 inverse_ = dem::Mat3::Identity(); ///< of sum X X^T [1/m^2]
};

} // namespace mergel::coupling
