/// Explicit motion of an elastic solid: leapfrog with local non-viscous damping
/// (fem/README.md, Explicit step).
#pragma once

#include "fem/solid/discrete_solid.h"
#include "fem/solid/shared_product.h"

#include <span>

namespace mergel::fem {

/// Energy of the solid [J]. For a constant time step the energy balance holds to round-off:
///
///   change of (kinetic + strain) =
///     interface_work + gravity_work + initial_stress_work - damping
///
/// Each kick adds dt f^n . (v^{n-1/2} + v^{n+1/2})/2 to a work. A change of the step from
/// dt_1 to dt_2 leaves an error of (dt_2 - dt_1)/4 (K u).(v^{n+1/2} - v^{n-1/2}) once, and
/// subcycling one that stays bounded, both of second order in dt (fem/README.md, Energy).
struct Energies {
  double kinetic = 0.0; ///< 1/2 m v^2 at n+1/2
  /// 1/2 u^n.K u^{n+s}: in the middle of a window of s steps, relative to the initial state
  double strain = 0.0;
  double interface_work = 0.0; ///< done on the solid by the interface forces, cumulative
  double gravity_work = 0.0;   ///< done by gravity, cumulative
  /// done by -f_initial, cumulative: by the initial stress and the pressures on the surface
  double initial_stress_work = 0.0;
  double damping = 0.0; ///< lost by damping, cumulative
};

/// State that a restart needs to continue with the same bits.
struct NodalMotion {
  NodalField u;           ///< displacement u^{n+1} [m]
  NodalField v;           ///< velocity v^{n+1/2} [m/s]
  NodalField Ku;          ///< internal force at the start of the window, u^n [N]
  NodalField f_interface; ///< P times the interface forces of the last step [N]
  Eigen::ArrayXd m;       ///< mass with which each node moves [kg], > 0
  double dt = 0.0;        ///< last time step [s]; 0 before the first
  double window = 0.0; ///< planned at the last kick by -K u [s]; half of it has been given
  double since = 0.0;  ///< time since that kick [s]
  std::size_t n_left = 0;   ///< steps until the next one
  std::size_t subcycle = 1; ///< steps of a window that begins now
  Energies energy;
};

/// Moves a solid, which it borrows and which must outlive it:
///
///   f = f_interface + f_gravity - f_initial - K u            at t^n
///   m (v^{n+1/2} - v^{n-1/2})/dt = P (f_c - alpha |f_c| sign(v_c))_c, each component c
///   u^{n+1} = u^n + dt v^{n+1/2}
///
/// The kick uses the mean of the old and the new dt; the first step takes the new one.
///
/// Subcycling by impulse: f_gravity - f_initial - K u kicks at every s-th step, for all s of
/// them; the interface forces kick their nodes at every step, and these drift at every step
/// (Tuckerman, Berne and Martyna 1992, Reversible multiple time scale molecular dynamics,
/// J. Chem. Phys. 97, 1990). All other nodes drift once in a window. The
/// first window after rest has one step.
class Leapfrog {
public:
  /// @param alpha local damping [-], 0 <= alpha < 1
  /// @param loaded nodes that take interface forces, in the order in which step() gets them
  /// @param comm ranks over which the product K u is distributed; each calls step() with
  ///   the same forces
  Leapfrog(const DiscreteSolid& solid, double alpha, std::vector<std::uint32_t> loaded,
           MPI_Comm comm = MPI_COMM_NULL);

  /// One step of dt [s] > 0 under forces f [N], one for each loaded node. Allocates
  /// nothing. Nodes that are not loaded have their u of the end of the window after its last
  /// step only.
  void step(double dt, std::span<const Vec3> f);

  /// Steps of a window, from the next one on. @param s >= 1
  void set_subcycle(std::size_t s) { now_.subcycle = s; }

  /// Set the solid at rest at u under forces f; all works start again from zero.
  void rest_at(const NodalField& u, std::span<const Vec3> f);

  /// Move on from rest with these masses of the nodes [kg], > 0: for settling.
  void set_masses(const Eigen::ArrayXd& m);

  double damping() const { return alpha_; }
  const NodalMotion& motion() const { return now_; }
  /// Throws std::invalid_argument when the arrays do not fit the solid.
  void restore(NodalMotion state);

  /// Energies after the last step.
  Energies energies() const;

  /// Unbalanced-force ratio [-] at the last step, with -K u of the start of its window:
  ///   sum_a |f_a| / sum_a (|f_interface| + |f_gravity| + |f_initial| + |K u|)_a
  /// over all nodes. Forces are projected with P, so reactions of supports do not count;
  /// f_a is taken before damping. 0 without any force.
  double unbalanced_ratio() const;

private:
  void load_interface_forces(std::span<const Vec3> f);
  void begin_again();
  void kick_all(double dt_kick, double window_kick);
  void kick_loaded(double dt_kick);
  void drift(double dt);

  /// Sums over the nodes of force times mean motion [J].
  struct Powers;
  NodeLanes kicked(Eigen::Index a, double dt_kick, double window_kick, Powers& sum) const;

  const DiscreteSolid& solid_;
  NodalField next_Ku_;    // of the window that begins next; outlives the product
  SharedProduct product_; // may still receive next_Ku_ when it ends
  double alpha_;
  std::vector<std::uint32_t> loaded_;
  Eigen::ArrayXd inverse_m_; // [1/kg]
  std::vector<char> is_loaded_;
  NodalMotion now_;
  bool is_product_begun_ = false; // next_Ku_ is on its way
};

} // namespace mergel::fem
