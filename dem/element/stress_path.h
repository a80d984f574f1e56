/// Loading stages of an element test: paths of a strain-controlled cell in stress and
/// strain (dem/README.md, Element tests; apps/element/README.md, Loading stages).
///
/// Here, as in soil mechanics, compression is positive. The axis is z; x and y are lateral.
#pragma once

#include "dem/element/servo.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

/// Stress and strain of a cell along x, y, z. Strains are engineering strains.
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
  /// Magnitude of the largest strain along an edge or in volume.
  double largest_strain() const
  {
    return std::max(strain.cwiseAbs().maxCoeff(), std::abs(volumetric_strain()));
  }
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
  resume ///< path of the previous stage, towards the new target: unloading and reloading
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
  controlled_stress ///< stress of the controlled axes; target of LoadingStage::returns
};

/// Value of a quantity [Pa] or [-].
double value_of(Quantity quantity, const SoilState& s);
bool is_strain(Quantity quantity);

/// Rule of one axis in a stage of kind `axes`: one axis is strain-controlled, the others
/// are fixed (no strain) or hold a stress.
struct AxisRule {
  enum class Kind { strain_controlled, fixed, stress_controlled };
  Kind kind = Kind::fixed;
  double stress = 0.0; ///< held [Pa]

  bool operator==(const AxisRule&) const = default;
};

/// One loading stage and its target.
struct LoadingStage {
  PathKind kind = PathKind::isotropic;
  double slope = 0.0;             ///< radial: dq/dp [-]; infinite for constant p
  bool has_lateral = false;       ///< triaxial: lateral stress is given
  double lateral = 0.0;           ///< lateral stress [Pa]; if not given it stays as it is
  std::array<AxisRule, 3> axes{}; ///< of kind `axes`: x, y, z
  Quantity quantity = Quantity::p;
  double target = 0.0;  ///< of `quantity`; strains count from the start of the stage
  bool returns = false; ///< resume: back to the stress at the start of the previous stage

  /// @throws InputError when a stage of this kind cannot reach its target
  void check() const;
  /// The same for a stage that resumes another one, which is not of kind `resume` itself.
  void check_after(const LoadingStage& resumed) const;

  bool operator==(const LoadingStage&) const = default;
};

/// State of the stage that is being run: plain data.
///
/// One axis is strain-controlled, z if possible, or several together. The other axes hold a
/// stress that follows the controlled stress, held = at_zero + slope * controlled stress,
/// or their own rules. If the stresses differ from these values at the start, an approach
/// brings them there first, on a line at constant q: see `offset`.
struct ActiveStage {
  enum class Controlled { all, axial, lateral, x, y };
  enum class Follow { mean, nothing, line, each }; ///< isotropic; oedometer; others; axes

  Controlled controlled = Controlled::axial;
  Follow follow = Follow::line;
  double at_zero = 0.0, slope = 0.0; ///< of the line [Pa], [-]
  std::array<AxisRule, 3> rules{};   ///< of Follow::each
  double direction = 1.0; ///< of the controlled strain: 1 compression, -1 extension
  double target = 0.0;
  Quantity quantity = Quantity::p;
  double controlled_stress_at_start = 0.0; ///< [Pa]
  double strain_at_start = 0.0;            ///< controlled strain [-], from size_0
  double value_at_start = 0.0;             ///< of the quantity of the target
  bool returns = false; ///< to the start of the previous stage, see `strain_to_return`
  double strain_to_return = 0.0; ///< controlled strain that ends a return at the latest [-]
  Vec3 size_0 = Vec3::Zero();    ///< from which the strains of the stage count [m]
  /// Stress of each axis minus the stress that it is to hold, at the start of the stage
  /// [Pa]; 0 for axes that hold none. During an approach the share `remaining` of it is
  /// added to the stresses to hold, and the strain-controlled axes hold their stress at the
  /// start; on a line (Follow::line) they follow the mean change of the stresses to hold,
  /// so that q stays what it was.
  Vec3 offset = Vec3::Zero();
  bool is_approaching = false;
  double remaining = 1.0; ///< share of `offset` [-]

  /// Stress of the strain-controlled axes: p if all are, lateral if x and y are [Pa].
  double controlled_stress(const SoilState& s) const;
  /// Their strain: volumetric if all axes are strain-controlled [-].
  double controlled_strain(const SoilState& s) const;
  /// A return also ends at the strain at which the previous stage began: a specimen that
  /// broke since then does not bear that stress again.
  bool has_reached_target(const SoilState& s) const;
  /// Progress of the target's quantity: 0 at the start, 1 at the target.
  double progress(const SoilState& s) const;
  /// Control of the next step, with controlled strain rates of this norm [1/s].
  CellControl control(const SoilState& s, double rate) const;
};

/// Begin a stage at the present state of the cell.
/// @param now   strains count from before.size_0; they are used only if the stage resumes
/// @param before the previous stage; a default one for the first stage
ActiveStage begin_stage(const LoadingStage& stage, const ActiveStage& before,
                        const SoilState& now, const Vec3& size);

} // namespace mergel::dem
