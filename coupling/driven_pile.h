/// The head of a pile: moves a rigid wall at a velocity or under a force, along its axis or
/// across it (coupling/README.md, Driven pile).
#pragma once

#include "coupling/structure.h"
#include "dem/io/state/named_numbers.h"
#include "dem/walls/rigid_wall.h"

namespace mergel::coupling {

/// What a pile has beside its shape; in a half model its half.
struct PileInertia {
  double mass = 0.0;    ///< [kg], > 0
  double length = 0.0;  ///< over which the mass is spread evenly, from the tip up [m], > 0
  double damping = 0.0; ///< local damping of motions that are not prescribed [-], in [0, 1)
};

/// What the head prescribes.
enum class HeadControl {
  velocity, ///< along z; no other motion
  force,    ///< along z; no other motion
  lateral ///< velocity of one point of the axis along x, force along z; free to rotate about y
};

/// What the head prescribes in a step, as its control says; the rest is not looked at.
struct HeadTarget {
  double v_z = 0.0;   ///< upwards [m/s]
  double force = 0.0; ///< downwards [N]
  double v_x = 0.0;   ///< of the pushed point [m/s]
};

/// Moves a rigid wall. At a prescribed velocity a pile has no inertia here: its head force is
/// what the particles resist with. Under a prescribed head force F, positive downwards, it
/// moves by
///
///   m dv_z/dt = f_z - F - alpha |f_z - F| sign v_z
///
/// with f the force of the particles, and where it is free to rotate by
///
///   I domega/dt = M - alpha |M| sign omega
///
/// with M their moment about the pushed point, to which all mass is assigned, and I that of a
/// slender rod about this point. Its weight is part of the head force. Leapfrog, in step with
/// the particles. Every rank has the same forces and gets the same bits.
class DrivenPile {
public:
  DrivenPile() = default;
  explicit DrivenPile(const PileInertia& inertia) : inertia_(inertia) {}

  /// Another control from the next step on; the motion is kept, but where a velocity is
  /// prescribed.
  void prescribe_velocity(const dem::RigidWall& wall);
  void prescribe_force(const dem::RigidWall& wall);
  /// Push at the point of the axis at this height [m]. It stays the same point in later calls.
  void push_at(double height, const dem::RigidWall& wall);

  /// Kick and drift: v^{n+1/2} and x^{n+1} of the wall, from the forces on it at x^n.
  /// @param dt_kick mean of the steps before and after [s]
  void step(dem::RigidWall& wall, const HeadTarget& target, double dt_kick, double dt);

  HeadControl control() const { return control_; }
  /// Downwards: prescribed at the last kick, or what the particles resist with now [N].
  double head_force(const dem::RigidWall& wall) const;
  /// Along x, what the particles resist with now [N].
  static double lateral_force(const dem::RigidWall& wall) { return -wall.resultant().x(); }
  /// Of the pushed point along x; 0 before it was pushed [m].
  double displacement(const dem::RigidWall& wall) const;
  double rotation() const { return angle_; } ///< about y: the head leans towards x [rad]

  /// Unbalanced force and moment of the free motions over the scale of the forces [-].
  /// @param scale [N], > 0
  double unbalanced(const dem::RigidWall& wall, double scale) const;
  /// Work of the head, of the particles on the pile, kinetic energy of its free motions.
  const StructureEnergies& energies() const { return energy_; }
  /// Not less than the squared frequency of the free motions on the contacts of this rank
  /// and, by `sum`, of the others [1/s^2]. Collective.
  double omega2(const dem::RigidWall& wall, const dem::Particles& particles,
                const dem::Communicator& comm) const;

  /// Its numbers and its control by name; `self` may be const.
  template <class Self>
  static dem::NumbersOf<Self> numbers_of(Self& self)
  {
    auto& e = self.energy_;
    return {{"pile: head force [N]", &self.head_force_},
            {"pile: pushed point above the tip [m]", &self.arm_},
            {"pile: rotation [rad]", &self.angle_},
            {"pile: velocity of the pushed point x [m/s]", &self.v_x_},
            {"pile: velocity of the pushed point z [m/s]", &self.v_z_},
            {"pile: spin [rad/s]", &self.omega_},
            {"pile: kinetic [J]", &e.kinetic},
            {"pile: work of the particles [J]", &e.wall_work},
            {"pile: work of the head [J]", &e.applied_work},
            {"pile: damping [J]", &e.damping}};
  }
  template <class Self>
  static dem::CountsOf<Self> counts_of(Self& self)
  {
    return {{"control of the head", &self.control_, HeadControl::lateral}};
  }

private:
  double moment_of_inertia() const; ///< about the pushed point [kg m^2]
  dem::Vec3 along_axis() const;     ///< from the origin of the wall to the pushed point [m]
  double moment(const dem::RigidWall& wall) const; ///< about the pushed point, y [N m]
  void take_over(HeadControl control, const dem::RigidWall& wall);
  void kick_z(double f_z, double force, double dt);
  void kick_across(const dem::RigidWall& wall, double v_x, double dt);
  void count_kinetic();

  PileInertia inertia_;
  HeadControl control_ = HeadControl::velocity;
  double head_force_ = 0.0;                    ///< prescribed at the last kick
  double arm_ = 0.0;                           ///< 0 before the pile was pushed
  double angle_ = 0.0;                         ///< about y
  double v_x_ = 0.0, v_z_ = 0.0, omega_ = 0.0; ///< at n+1/2, of the pushed point
  StructureEnergies energy_;
};

} // namespace mergel::coupling
