/// Paths in stress and strain along which a driven cell is led, leg by leg.
///
/// Here, as in soil mechanics, compression is positive. The axis is z; x and y are lateral.
#pragma once

#include "dem/element/servo.h"

namespace mergel::dem {

/// A cell as an element test sees it, along x, y, z. Strains are engineering strains.
struct SoilState {
  Vec3 stress = Vec3::Zero(); ///< [Pa]
  Vec3 strain = Vec3::Zero(); ///< [-]

  double axial() const { return stress.z(); }
  double lateral() const { return 0.5 * (stress.x() + stress.y()); }
  double p() const { return stress.mean(); }
  double q() const { return axial() - lateral(); }
  double axial_strain() const { return strain.z(); }
  double lateral_strain() const { return 0.5 * (strain.x() + strain.y()); }
  double volumetric_strain() const { return 1.0 - (Vec3::Ones() - strain).prod(); }
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
  axes,        ///< each axis by its own rule
  resume       ///< as the leg before, the way that the goal lies: unloading and reloading
};

enum class Quantity {
  p,
  q,
  axial_stress,
  lateral_stress,
  x_stress,
  y_stress,
  axial_strain,
  x_strain,
  y_strain,
  volumetric_strain,
  driven_stress ///< where the leg before was taken up, see Leg::returns
};

/// Value of a quantity [Pa] or [-].
double value_of(Quantity quantity, const SoilState& s);
bool is_strain(Quantity quantity);

/// What one axis of a leg of kind `axes` does: one axis is driven, the others are fixed
/// (no strain) or hold a stress.
struct AxisRule {
  enum class Kind { driven, fixed, held };
  Kind kind = Kind::fixed;
  double stress = 0.0; ///< held [Pa]

  bool operator==(const AxisRule&) const = default;
};

/// One leg of a path and where it ends.
struct Leg {
  PathKind kind = PathKind::isotropic;
  double slope = 0.0;             ///< radial: dq/dp [-]; infinite for constant p
  bool has_lateral = false;       ///< triaxial: lateral stress is given
  double lateral = 0.0;           ///< then [Pa]; else it stays what it was
  std::array<AxisRule, 3> axes{}; ///< of kind `axes`: x, y, z
  Quantity quantity = Quantity::p;
  double goal = 0.0;    ///< of `quantity`; strains count from the start of the leg
  bool returns = false; ///< resume: back to the stress at which the last leg began

  /// @throws InputError when the leg cannot reach its goal by its kind
  void check() const;
  /// The same of a leg that resumes another, which is not itself a resuming one.
  void check_after(const Leg& resumed) const;

  bool operator==(const Leg&) const = default;
};

/// A leg being followed: plain state.
///
/// One stress is driven by a strain rate, the axial one if possible; the others follow it,
/// held = at_zero + slope * driven, or as their own rules say. Where they start away from
/// what they shall hold, they are brought there first: see `offset`.
struct Course {
  enum class Drive { all, axial, lateral, x, y };
  enum class Follow { mean, nothing, line, each }; ///< isotropic; oedometer; others; axes

  Drive drive = Drive::axial;
  Follow follow = Follow::line;
  double at_zero = 0.0, slope = 0.0; ///< of the line [Pa], [-]
  std::array<AxisRule, 3> rules{};   ///< of Follow::each
  double direction = 1.0;            ///< of the driven strain: 1 compression, -1 extension
  double goal = 0.0;
  Quantity quantity = Quantity::p;
  double driven_at_start = 0.0;  ///< stress [Pa]
  double strain_at_start = 0.0;  ///< driven [-], from size_0
  double value_at_start = 0.0;   ///< of the quantity of the goal
  bool returns = false;          ///< to where the leg before began, see `strain_to_return`
  double strain_to_return = 0.0; ///< at which a return ends at the latest [-]
  Vec3 size_0 = Vec3::Zero();    ///< from which the strains of the leg count [m]
  /// Stress of the axes over what they shall hold when the leg is set out on [Pa]; 0 of
  /// those that hold none. In an approach `remaining` of it is held on top, and the driven
  /// axes hold the stress that they have.
  Vec3 offset = Vec3::Zero();
  bool is_approaching = false;
  double remaining = 1.0; ///< share of `offset` [-]

  double driven(const SoilState& s) const;        ///< stress [Pa]
  double driven_strain(const SoilState& s) const; ///< volumetric where all are driven [-]
  /// A return also ends where the strain is back at which it was left: a rock that broke on
  /// the way does not bear that stress again.
  bool has_reached_goal(const SoilState& s) const;
  /// How far the goal's quantity came, 0 at the start to 1.
  double progress(const SoilState& s) const;
  /// For the next step, with driven rates of this norm [1/s].
  CellOrder order(const SoilState& s, double rate) const;
};

/// Set out on a leg from where the cell is.
/// @param now   strains count from before.size_0; they are read where the leg resumes
/// @param before the leg before; a default one in the beginning
Course set_out(const Leg& leg, const Course& before, const SoilState& now,
               const Vec3& size);

} // namespace mergel::dem
