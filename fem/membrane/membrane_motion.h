/// Explicit motion of a membrane under pressure, nodal forces and guided nodes (fem/README.md,
/// Membrane).
#pragma once

#include "fem/membrane/membrane.h"

#include <span>

namespace mergel::fem {

/// Nodes whose motion is prescribed, along z or altogether.
struct GuidedNodes {
  std::vector<int> nodes;
  bool along_z_only = true; ///< else all three components
};

/// Energy of a membrane [J]:
///
///   change of (kinetic + strain) = load_work + pressure_work + guide_work - damping
///
/// All at n+1/2. Works and damping are cumulative. The balance is off by an error of second
/// order in the window, which stays bounded: for nodes that the loads press on by f, about
/// (f dt)^2/m where windows have four steps.
struct MembraneEnergies {
  double kinetic = 0.0; ///< of the velocity without its saw in a window
  double strain = 0.0;
  double load_work = 0.0; ///< done by the nodal forces
  double pressure_work =
      0.0;                 ///< by the pressure: -p dV, less what it does on the end areas
  double guide_work = 0.0; ///< by what guides nodes
  double damping = 0.0;
};

/// What a restart needs to continue with the same bits. Fields that are said to be of its nodes
/// have what a rank needs there; elsewhere they have any number.
struct MembraneState {
  NodalField x;   ///< x^{n+1} [m]
  NodalMessage v; ///< v^{n+1/2} [m/s]
  NodalField
      f_own;    ///< of stretch and pressure at the start of the window, of its nodes [N]
  NodalField f; ///< nodal forces of the last step, of its nodes [N]
  /// Of its nodes, a column each: work of the nodal forces, work of the guides, loss by
  /// damping, 0 [J].
  NodalField work;
  Eigen::ArrayXd m;           ///< [kg], > 0
  double pressure = 0.0;      ///< as set last [Pa]
  double next_pressure = 0.0; ///< in the own forces computed last [Pa]
  double dt = 0.0;            ///< last time step [s]; 0 before the first
  double window = 0.0;        ///< planned at the last kick by f_own [s]
  double since = 0.0;         ///< time since that kick [s]
  std::size_t n_left = 0;     ///< steps until the next one
  std::size_t subcycle = 1;   ///< steps of a window that begins now
  double work_pressure = 0.0; ///< pressure up to which its work is added [Pa]
  EnclosedVolume work_volume; ///< and the volume
  std::size_t n_volume = 0;   ///< windows since
  double pressure_work = 0.0; ///< [J]
};

/// Moves a membrane: leapfrog as for the far field (fem/README.md, Explicit step), with its own
/// forces, those of stretch and pressure, at every s-th step by impulse.
///
/// Each rank kicks its own nodes and tells the others their velocities; then every rank moves all
/// nodes. No bit depends on the number of ranks.
class MembraneMotion {
public:
  /// @param alpha local damping [-], in [0, 1)
  MembraneMotion(Membrane membrane, const Tube& tube, double alpha,
                 std::vector<GuidedNodes> guides);

  /// One step of dt [s] > 0 under the nodal forces f [N]; those of other ranks' nodes are not
  /// read. Collective.
  /// @param guided velocity over the step of the nodes of all guides, one after the other
  ///   [m/s]
  void step(double dt, std::span<const Vec3> f, std::span<const Vec3> guided);

  /// From the window after the next kick on, from rest at once [Pa].
  void set_pressure(double p) { now_.pressure = p; }
  void set_subcycle(std::size_t s) { now_.subcycle = s; }
  /// Move on from rest with these masses [kg], > 0.
  void set_masses(const Eigen::ArrayXd& m);

  const Membrane& membrane() const { return membrane_; }
  const Tube& tube() const { return tube_; }
  double damping() const { return alpha_; }
  const MembraneState& state() const { return now_; }
  /// Whether a component of a node is free.
  const Eigen::Array<double, 4, Eigen::Dynamic>& free() const { return free_; }
  /// @param state its fields complete
  void restore(MembraneState state);

  MembraneEnergies energies() const; ///< collective
  /// Sum of |f| over the free components of all nodes, over that of its two parts. Collective.
  double unbalanced_ratio() const;
  EnclosedVolume enclosed() const { return membrane_.enclosed(now_.x, tube_); }

private:
  void kick(double dt_kick, double window_kick, std::span<const Vec3> f);
  void guide(double dt_kick, double window_kick, std::span<const Vec3> guided,
             const NodalMessage& v_before);
  void move(double dt);
  void add_pressure_work();

  Membrane membrane_;
  Tube tube_;
  double alpha_;
  std::vector<GuidedNodes> guides_;
  NodalField free_; // 1 where free, 0 where guided
  Eigen::ArrayXd inverse_m_;
  MembraneState now_;
};

} // namespace mergel::fem
