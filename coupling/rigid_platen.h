/// A rigid triangulated platen: moves along its axis at a velocity or under a force, and
/// stays level or tilts freely (coupling/README.md, Rigid platen).
#pragma once

#include "coupling/platen_mesh.h"
#include "coupling/structure.h"

#include <Eigen/Geometry>

#include <variant>

namespace mergel::coupling {

/// What moves a platen along its axis.
struct VelocityDrive {
  double v = 0.0; ///< prescribed, positive towards the particles [m/s]
};
struct ForceDrive {
  double f = 0.0; ///< acts beside the particles, positive towards them [N]
};
using PlatenDrive = std::variant<VelocityDrive, ForceDrive>;

struct PlatenSpec {
  PlatenMesh mesh;
  PlatenDrive drive;
  bool is_free_to_tilt = false; ///< about the two axes normal to its own
  double mass = 0.0;            ///< [kg], >= 0; > 0 for a motion that is not prescribed
  double damping = 0.0; ///< local damping of motions that are not prescribed [-], in [0, 1)

  /// @throws InputError naming the value, what is allowed and a remedy
  void check() const;
};

/// Resultants of the particles' forces on a platen.
struct PlatenLoad {
  double f = 0.0;                       ///< along the axis; negative when they press [N]
  dem::Vec3 moment = dem::Vec3::Zero(); ///< about the centre [N m]
  double sum_f = 0.0;                   ///< sum of the magnitudes of the nodal forces [N]
  double sum_moment = 0.0;              ///< the same times their arms [N m]
};

/// Where a platen is and how it moves: what a restart needs.
struct PlatenMotion {
  double dt = 0.0;     ///< last step [s]; 0 before the first
  double travel = 0.0; ///< of the centre along the axis [m]
  double v = 0.0;      ///< along the axis [m/s]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  /// About the axes of tilting, which turn with the platen [rad/s].
  Eigen::Vector2d omega = Eigen::Vector2d::Zero();
  Nodal x_nodes, v_nodes;   ///< [m], [m/s]
  PlatenLoad load;          ///< at the last kick
  double drive_force = 0.0; ///< at the last kick, beside the particles' [N]
  StructureEnergies energy; ///< works and damping
};

/// A platen without weight; what it weighs is part of the force that drives it.
///
/// It has the mass of a thin plate that is spread evenly over its triangles. The centre of
/// this mass moves along the axis alone, and the platen does not spin about its axis.
class RigidPlaten final : public Structure {
public:
  /// @throws InputError as spec.check()
  explicit RigidPlaten(PlatenSpec spec);

  /// Another velocity or force, from the next step on.
  /// @throws std::logic_error for the other kind of drive
  void set_drive(const PlatenDrive& drive);

  const PlatenMotion& motion() const { return now_; }
  dem::Vec3 axis() const { return now_.rotation * spec_.mesh.axis; } ///< tilted, unit
  /// Of a point that moves with it [m/s].
  dem::Vec3 velocity_at(const dem::Vec3& x) const;
  double inertia() const { return inertia_(0, 0); } ///< about the first axis of tilting

  Interface interface(const dem::ContactLaw& contact) const override;
  bool moves() const override { return true; }
  void positions(Nodal& x) const override { x = now_.x_nodes; }
  void velocities(Nodal& v) const override { v = now_.v_nodes; }
  void step(double dt, const Nodal& f) override;
  /// None: a platen alone has no stiffness.
  std::optional<Nodal> solve_static(const Nodal& f) override;
  void equalise_frequencies(double, std::span<const double>) override {}
  void restore_masses() override; ///< it kept its mass
  void choose_subcycle(double, std::span<const double>, double, std::size_t) override {}
  Subcycle subcycle() const override { return {}; } // it has no forces of its own
  double damping() const override { return spec_.damping; }
  std::size_t n_amplitudes() const override;
  void move(std::span<const double> y, Nodal& u) const override;
  void multiply(std::span<const double> y, const Nodal& f,
                std::span<double> to) const override;
  double unbalanced_ratio() const override;
  StructureEnergies energies() const override;
  void save(dem::State& state, const std::string& name) const override;
  void load(const dem::State& state, const std::string& name) override;

private:
  /// Up to three: along the axis, about both axes of tilting.
  struct FreeMotions {
    std::vector<Eigen::Matrix3Xd> of_node; ///< motion of each node, a column a free motion
    Eigen::MatrixXd inverse_root;          ///< L^-1 with M = L L^T
  };

  bool is_driven_by_force() const
  {
    return std::holds_alternative<ForceDrive>(spec_.drive);
  }
  dem::Vec3 centre() const { return centre_0_ + now_.travel * spec_.mesh.axis; }
  PlatenLoad sum(const Nodal& f) const;
  FreeMotions free_motions() const;
  void kick_axis(double dt);
  void kick_tilt(double dt);
  void turn(double dt);
  void move_nodes(double dt);
  Nodal rigid_positions() const;

  PlatenSpec spec_;
  dem::Vec3 centre_0_;                   ///< of mass, in the reference position [m]
  Nodal r_0_;                            ///< nodes less that centre [m]
  Eigen::Matrix<double, 3, 2> in_plane_; ///< axes of tilting, in the reference position
  Eigen::Matrix2d inertia_;              ///< about these, through the centre [kg m^2]
  PlatenMotion now_;
};

} // namespace mergel::coupling
