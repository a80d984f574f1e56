/// A rock in its far field, from specimen to equilibrium: what a job then drives.
#pragma once

#include "apps/case/coupled_case.h"
#include "coupling/exchange.h"
#include "coupling/interface_balance.h"
#include "dem/assembly/energy_balance.h"
#include "dem/io/state/state_file.h"

#include <functional>

namespace mergel::apps {

/// How far a rock is on its way to equilibrium.
struct Settling {
  enum class Stage { held, free, done } stage = Stage::held;
  std::size_t n = 0; ///< steps in this stage
};

/// The rock, the far field and what ties them. Kept in one place because the parts refer to
/// each other.
struct CoupledRock {
  dem::Rock rock;
  fem::FarField far_field;
  coupling::Exchange exchange;
  coupling::Nodal x_interface; ///< reference positions of the far-field interface nodes [m]
  FarFieldModel model;
  double dt = 0.0;        ///< present step [s]; only ever lowered
  double dt_before = 0.0; ///< the step before [s]
  double safety = 0.7;
  std::size_t n_steps = 0;
  double time = 0.0;          ///< since the specimen was put in its walls [s]
  Settling settling;          ///< kept by equilibrate()
  std::vector<dem::Vec3> x_0; ///< grains in equilibrium, set by equilibrate() [m]

  CoupledRock(const RockCase& c, const dem::Sample& sample, fem::FarField far_field,
              coupling::Interface interface);
  /// As it was when put() wrote the state, with the piles that it had then; collective.
  /// The state is freed on the way.
  /// @throws InputError when the state is of another rock
  CoupledRock(const RockCase& c, dem::State& state, std::vector<dem::PileWall> piles,
              fem::FarField far_field, coupling::Interface interface);
  CoupledRock(const CoupledRock&) = delete;
  CoupledRock& operator=(const CoupledRock&) = delete;

  /// One step of rock and far field; `move_pile(dt)` moves what else is driven.
  /// @throws Unstable naming what went wrong, the step and the time
  template <class MovePile>
  void step(MovePile&& move_pile)
  {
    if (n_steps % steps_between_checks == 0)
      lower_time_step(n_steps % steps_between_far_field_checks == 0);
    if (n_steps % steps_between_shares == 0) even_out();
    try {
      dem::advance(rock, dt_before, dt, [&](double h) {
        if (model == FarFieldModel::elastic) exchange.step(rock.walls.front(), h);
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

  /// Re-evaluate the critical step of the grains, and of the far field too; lower dt if it
  /// fell. Collective.
  void lower_time_step(bool far_field_too);

  /// Give ranks that were slow fewer grains; no bit of the results depends on it.
  void even_out();

  /// Larger of the unbalanced-force ratios of grains and far field.
  double unbalanced() const;

  coupling::InterfaceBalance balance();

  /// Energy that neither book explains since `start` [J], the far field's included.
  struct Books {
    dem::EnergyBook rock;
    fem::Energies far_field;
  };
  Books books() const;
  static double unexplained(const Books& now, const Books& start);

  static constexpr std::size_t steps_between_checks = 100;
  static constexpr std::size_t steps_between_far_field_checks = 5000;
  static constexpr std::size_t steps_between_shares = 1000;
  static constexpr double imbalance_allowed = 1.05; ///< slowest over fastest rank

  /// Add all that the constructor above needs; collective.
  void put(dem::State& state) const;

private:
  CoupledRock(const RockCase& c, fem::FarField far_field, coupling::Interface interface);

  std::string where() const; ///< the run is, in words

  double spent_before_ = 0.0; ///< of rock.times at the last even_out() [s]
};

/// The far field of a case; sets the number of faces around its side, which the specimen
/// must fit. @throws std::invalid_argument as fem::FarField does
fem::FarField make_far_field(RockCase& c);

/// Bring it to equilibrium (design section 8): walls held, rock relaxed; static solve of
/// the far field under the rock's forces, rock moved with it; both relaxed. Goes on where
/// `coupled.settling` stands.
/// @param after_step called between two steps, for checkpoints
/// @throws Unstable when a bond breaks or equilibrium is not reached in `most_steps`
void equilibrate(CoupledRock& coupled, double ratio, std::size_t most_steps,
                 const std::function<void()>& after_step);

} // namespace mergel::apps
