/// Two bonded particles with an imposed relative motion: a bond law by itself. The pair is
/// computed by the kernel of all other jobs.
#pragma once

#include "dem/pairs/forces.h"

namespace mergel::dem {

/// Motion of particle j relative to particle i since the bond was made. Shear acts along
/// one axis of the contact plane, rotation about the other, so V and M are those of a plane
/// beam.
struct RelativeMotion {
  double u_n = 0.0;   ///< growth of the gap [m]
  double u_s = 0.0;   ///< at the contact point, summed along the path [m]
  double theta = 0.0; ///< summed along the path [rad]
};

struct ControlledPairSpec {
  double R_i = 0.0, R_j = 0.0; ///< radii [m], > 0
  double S = 1.0;              ///< upscaling ratio of both [-], > 0
  double gap_0 = 0.0;          ///< gap at which they are bonded [m]
  PairMaterials material;
};

/// Loads of the pair: N tension positive, V and M signed along their axes.
struct ControlledPairReading {
  double N, V, M;     ///< of the bond [N], [N], [N m]
  double D;           ///< damage [-]
  double f_n, f_s;    ///< of the contact beside it, compression positive [N]
  double f;           ///< yield function at the effective loads [-]
  RelativeMotion u_p; ///< plastic part of the motion; after breakage its last value
  double stored;      ///< in bond and contact [J]
};

class ControlledPair {
public:
  explicit ControlledPair(const ControlledPairSpec& spec);

  /// One step from the present motion to this one.
  /// @pre the centres stay apart: gap_0 + u_n > -(R_i + R_j)
  void move_to(const RelativeMotion& motion);

  ControlledPairReading read() const;
  const RelativeMotion& motion() const { return at_; }
  /// Of the intact bond.
  const BondShape<double>& shape() const { return shape_; }
  double work() const { return work_; } ///< done by the motion so far, trapezoidal [J]
  double dissipated() const;            ///< by plasticity, damage, breakage and slip [J]

private:
  EffectiveLoads<double> effective_loads() const; ///< zero once the bond is broken

  PairMaterials material_;
  double gap_0_;
  Particles particles_;
  Bonds bonds_;
  PairLosses losses_;
  BondShape<double> shape_;
  RelativeMotion at_, u_p_;
  double work_ = 0.0;
};

} // namespace mergel::dem
