/// Paths in stress and strain along which a driven cell is led, leg by leg.
///
/// Here, as in soil mechanics, compression is positive. The axis is z; x and y are lateral.
#pragma once

#include "dem/servo.h"

namespace mergel::dem {

/// A cell as an element test sees it. Strains are engineering strains.
struct SoilState {
  double axial = 0.0, lateral = 0.0; ///< stress, lateral the mean of both [Pa]
  double axial_strain = 0.0, lateral_strain = 0.0, volumetric_strain = 0.0; ///< [-]

  double p() const { return (axial + 2.0 * lateral) / 3.0; }
  double q() const { return axial - lateral; }
};

/// @param stress along the edges, tension positive [Pa]; @param size edges of the cell [m];
///   @param size_0 those from which strains count [m], > 0
SoilState soil_state(const Vec3& stress, const Vec3& size, const Vec3& size_0);

enum class PathKind {
  isotropic,   ///< equal stress on all axes
  oedometer,   ///< no lateral strain
  triaxial,    ///< constant lateral stress
  radial,      ///< dq/dp constant
  compression, ///< uniaxial: lateral stress 0
  tension,     ///< the same, pulled
  resume       ///< as the leg before, the way that the goal lies: unloading and reloading
};

enum class Quantity {
  p,
  q,
  axial_stress,
  lateral_stress,
  axial_strain,
  volumetric_strain,
  driven_stress ///< where the leg before was taken up, see Leg::returns
};

/// Value of a quantity [Pa] or [-].
double value_of(Quantity quantity, const SoilState& s);
bool is_strain(Quantity quantity);

/// One leg of a path and where it ends.
struct Leg {
  PathKind kind = PathKind::isotropic;
  double slope = 0.0;       ///< radial: dq/dp [-]; infinite for constant p
  bool has_lateral = false; ///< triaxial: lateral stress is given
  double lateral = 0.0;     ///< then [Pa]; else it stays what it was
  Quantity quantity = Quantity::p;
  double goal = 0.0;    ///< of `quantity`; strains count from the start of the leg
  bool returns = false; ///< resume: back to the stress at which the last leg began

  /// @throws InputError when the leg cannot reach its goal by its kind
  void check() const;
};

/// A leg being followed: plain state.
///
/// One stress is driven by a strain rate, the axial one if possible; the others follow it,
/// held = at_zero + slope * driven.
struct Course {
  enum class Drive { all, axial, lateral };
  enum class Follow { mean, nothing, line }; ///< isotropic; oedometer; all others

  Drive drive = Drive::axial;
  Follow follow = Follow::line;
  double at_zero = 0.0, slope = 0.0; ///< of the line [Pa], [-]
  double direction = 1.0;            ///< of the driven strain: 1 compression, -1 extension
  double goal = 0.0;
  Quantity quantity = Quantity::p;
  double driven_at_start = 0.0; ///< stress [Pa]
  double value_at_start = 0.0;  ///< of the quantity of the goal
  Vec3 size_0 = Vec3::Zero();   ///< from which the strains of the leg count [m]

  double driven(const SoilState& s) const;
  bool has_reached_goal(const SoilState& s) const;
  /// How far the goal's quantity came, 0 at the start to 1.
  double progress(const SoilState& s) const;
  /// For the next step, with driven rates of this norm [1/s].
  CellOrder order(const SoilState& s, double rate) const;
};

/// Set out on a leg from where the cell is.
/// @param now   strains are not read
/// @param before the leg before; a default one in the beginning
Course set_out(const Leg& leg, const Course& before, const SoilState& now,
               const Vec3& size);

} // namespace mergel::dem
