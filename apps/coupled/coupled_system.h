/// A coupled system: the assembly in its far field, from the specimen to equilibrium
/// (coupling/README.md, Start of a coupled run).
#pragma once

#include "apps/case/coupled_case.h"
#include "coupling/exchange.h"
#include "coupling/interface_balance.h"
#include "dem/assembly/energy_balance.h"
#include "dem/io/state/state_file.h"

#include <functional>

namespace mergel::apps {

/// Progress of a coupled system towards equilibrium: walls held, both free, done.
struct Settling {
  enum class Phase { held, free, done } phase = Phase::held;
  std::size_t n = 0; ///< steps in this phase
};

/// Assembly, far field and exchange. Neither copied nor moved, because the parts refer to
/// each other.
struct CoupledSystem {
  dem::Assembly assembly;
  fem::FarField far_field;
  coupling::Exchange exchange;
  coupling::Nodal x_interface; ///< reference positions of the far-field interface nodes [m]
  FarFieldModel model;
  double dt = 0.0;        ///< time step [s]; never grows
  double dt_before = 0.0; ///< previous time step [s]
  double safety = dem::default_safety;
  std::size_t n_steps = 0;
  double time = 0.0;          ///< since the specimen was placed in its walls [s]
  Settling settling;          ///< advanced by equilibrate()
  std::vector<dem::Vec3> x_0; ///< positions in equilibrium, set by equilibrate() [m]

  /// @param comm of the far field too; must outlive the object
  CoupledSystem(const CoupledCase& c, const dem::Sample& sample, fem::FarField far_field,
                coupling::Interface interface, MPI_Comm comm);
  /// As it was when save() wrote the state; collective. Empties the state.
  /// @param piles those that it had then
  /// @throws InputError when the state is of another system
  CoupledSystem(const CoupledCase& c, dem::State& state, std::vector<dem::PileWall> piles,
                fem::FarField far_field, coupling::Interface interface, MPI_Comm comm);
  CoupledSystem(const CoupledSystem&) = delete;
  CoupledSystem& operator=(const CoupledSystem&) = delete;

  /// One step of assembly and far field; `move_pile(dt)` moves the pile.
  /// @throws Unstable naming the failure, the step and the time
  template <class MovePile>
  void step(MovePile&& move_pile)
  {
    if (n_steps % dem::steps_between_step_checks == 0)
      lower_time_step(n_steps % steps_between_far_field_checks == 0);
    if (n_steps % steps_between_load_checks == 0) balance_load();
    try {
      dem::advance(assembly, dt_before, dt, [&](double h) {
        if (model == FarFieldModel::elastic) exchange.step(assembly.walls.front(), h);
        move_pile(h);
      });
    } catch (const Unstable& e) {
      throw Unstable(e.what() + where());
    } catch (const NumericalError& e) {
      throw NumericalError(e.what() + where());
    }
    dt_before = dt;
    time += dt;
    ++n_steps;
  }

  /// Compute the critical step of the particles again, and of the far field if
  /// `far_field_too`; lower dt where it fell. Collective.
  void lower_time_step(bool far_field_too);

  /// Give slow ranks fewer particles. The results do not depend on it, bit for bit.
  /// Collective.
  void balance_load();

  /// Larger of the unbalanced-force ratios of particles and far field.
  double unbalanced() const;

  coupling::InterfaceBalance balance();

  struct EnergyBalances {
    dem::EnergyBalance assembly;
    fem::Energies far_field;
  };
  EnergyBalances energy_balances() const;
  /// Sum of the errors of both energy balances since `start` [J].
  static double unexplained(const EnergyBalances& now, const EnergyBalances& start);

  static constexpr std::size_t steps_between_far_field_checks = 5000;
  static constexpr std::size_t steps_between_load_checks = 1000;
  static constexpr double imbalance_allowed = 1.05; ///< slowest over fastest rank

  /// Add the arrays that the constructor above reads; collective.
  void save(dem::State& state) const;

private:
  CoupledSystem(const CoupledCase& c, fem::FarField far_field,
                coupling::Interface interface);

  std::string where() const; ///< step and time, for messages

  double spent_before_ = 0.0; ///< computing time at the last balance_load() [s]
};

/// The far field of a case. Sets in `c` the number of faces of its side, inside which the
/// specimen is made. @throws std::invalid_argument as fem::FarField does
fem::FarField make_far_field(CoupledCase& c, MPI_Comm comm);

/// Bring the system to equilibrium (coupling/README.md, Start of a coupled run): the
/// assembly settles in held walls; the far field is solved under its forces and the
/// particles follow; both settle together. Continues from `coupled.settling`.
/// @param ratio      unbalanced-force ratio to reach [-]
/// @param most_steps per phase
/// @param after_step called between two steps, for checkpoints
/// @throws Unstable when a bond breaks or equilibrium is not reached in `most_steps`
void equilibrate(CoupledSystem& coupled, double ratio, std::size_t max_steps,
                 const std::function<void()>& after_step);

} // namespace mergel::apps
