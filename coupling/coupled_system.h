/// An assembly and the structures that move its walls (coupling/README.md, Coupled step).
#pragma once

#include "coupling/energy_balances.h"
#include "coupling/exchange.h"
#include "coupling/interface_balance.h"
#include "coupling/structure_system.h"
#include "dem/assembly/mass_scaling.h"
#include "dem/assembly/step.h"
#include "dem/assembly/timestep.h"
#include "dem/pairs/strength.h"
#include "dem/specimen/bonding.h"

#include <memory>

namespace mergel::coupling {

/// How particles are held at the plane y = 0.
enum class SymmetryPlane {
  none,    ///< there is no such plane
  contact, ///< particles and their images are in contact only
  bonded   ///< and bonded
};

/// What a coupled system has besides particles and structures.
struct CoupledSpec {
  dem::PairMaterials material;
  dem::Motion motion;               ///< of the particles
  double skin = 0.0;                ///< of the Verlet list at S = 1 [m], > 0
  dem::StepSpec step;               ///< rule and safety of the time step
  std::size_t largest_subcycle = 1; ///< of the structures: steps from kick to kick by their
                                    ///< own forces, at most
  dem::MassScalingSpec mass_scaling;            ///< of the particles; off by default
  SymmetryPlane symmetry = SymmetryPlane::none; ///< of a half model
  dem::StrengthVariability strengths;           ///< drawn again when a state is loaded
  bool is_smooth_while_held = false; ///< the walls of the structures, in the first phase
                                     ///< of settling
};

/// A structure on its way into a coupled system.
struct StructureSpec {
  std::string name; ///< beginning of its names in a checkpoint, such as "far_field"
  std::unique_ptr<Structure> structure;
  dem::ContactLaw contact;  ///< of the particles with its wall
  bool is_bonded = false;   ///< particles near its wall are bonded to it at the start
  bool bonds_yield = false; ///< these bonds follow the bond law, else stay elastic
};

/// Progress of a coupled system towards equilibrium: walls held, both free, done.
struct Settling {
  enum class Phase { held, free, done } phase = Phase::held;
  std::size_t n = 0; ///< steps in this phase
};

/// Neither copied nor moved, because the exchanges refer to the structures.
struct CoupledSystem {
  /// A structure and its wall.
  struct Member {
    std::string name;
    std::unique_ptr<Structure> structure;
    std::size_t wall; ///< index of the wall of the assembly that it moves
    Exchange exchange;
  };

  dem::Assembly assembly;
  std::vector<Member> structures;
  bool are_structures_held = false; ///< true: none takes part in the steps
  bool is_smooth_while_held = false;
  dem::StepSpec step_spec;
  dem::MassScalingSpec mass_scaling;
  std::size_t largest_subcycle = 1;
  dem::StableStep stable_step;
  double dt = 0.0;        ///< time step [s]
  double dt_before = 0.0; ///< previous time step [s]
  std::size_t n_steps = 0;
  double time = 0.0;          ///< since the specimen was placed in its walls [s]; that of
                              ///< settling has no meaning, for it has masses of its own
  Settling settling;          ///< advanced by equilibrate()
  std::vector<dem::Vec3> x_0; ///< positions in equilibrium, set by equilibrate() [m]

  /// Particles at rest between the walls of the structures; collective.
  /// @param bonding its largest gap holds for walls and symmetry plane too
  CoupledSystem(const CoupledSpec& spec, std::vector<StructureSpec> structures,
                const dem::Particles& particles, const dem::Bonding& bonding,
                MPI_Comm comm);
  /// As it was when save() wrote the state; collective. Empties the state.
  /// @param rigid_walls those that it had then
  /// @throws InputError when the state is of another system
  CoupledSystem(const CoupledSpec& spec, std::vector<StructureSpec> structures,
                dem::State& state, std::vector<dem::RigidWall> rigid_walls, MPI_Comm comm);
  CoupledSystem(const CoupledSystem&) = delete;
  CoupledSystem& operator=(const CoupledSystem&) = delete;

  /// One coupled step (coupling/README.md, Coupled step). `move_others(dt)` moves the walls
  /// that belong to no structure.
  /// @throws Unstable naming the failure, the step and the time
  template <class MoveOthers>
  void step(MoveOthers&& move_others);

  /// The same while the particles are held: only the structures move. Collective.
  void step_with_particles_held();

  /// Compute the stable step from the largest frequency of all that acts now, and take the
  /// time step from it. To be called where what takes part has changed. Collective.
  void find_time_step();

  /// For settling: masses by which all that is free to move has about the same frequency, that
  /// of the stiffest particle. The time step follows. Collective.
  void equalise_frequencies();
  /// The masses of the run, true ones but for the mass scaling, from rest. The time step
  /// follows. Collective.
  void restore_masses();

  /// Whether an equilibrium is waited for. Then the structures' own forces act at every step: as
  /// impulses at every s-th one they shake what touches them, and the unbalanced-force ratio
  /// would not fall below that. Not stored: to be said again after a restart. Collective.
  void wait_for_equilibrium(bool is_waited_for);

  /// Give slow ranks fewer particles. The results do not depend on it, bit for bit.
  /// Collective.
  void balance_load();

  /// Largest of the unbalanced-force ratios of particles and moving structures.
  double unbalanced() const;

  /// Worst of the interface balances of all structures; collective.
  InterfaceBalance balance();

  EnergyBalances energy_balances() const;

  /// Wall-clock time spent in all structures, and in the exchanges [s].
  double structure_seconds() const;
  double exchange_seconds() const;

  bool moves(const Member& s) const { return !are_structures_held && s.structure->moves(); }
  dem::Wall& wall_of(const Member& s) { return assembly.walls[s.wall]; }

  static constexpr std::size_t steps_between_load_checks = 1000;
  static constexpr double imbalance_allowed = 1.05; ///< slowest over fastest rank

  /// Add the arrays that the constructor above reads; collective.
  void save(dem::State& state) const;

private:
  /// Walls without particles. Takes the structures out of `specs`.
  CoupledSystem(const CoupledSpec& spec, std::vector<StructureSpec>& specs);

  void move_structures(double h);           ///< under the forces at x^n, with their walls
  StructureSystem structure_system() const; ///< of the structures that move
  double largest_damping(const StructureSystem& system) const;
  void check_time_step();
  void choose_subcycles();
  std::vector<double> stiffness_at(const Member& s, const dem::Springs& springs) const;
  std::string where() const; ///< step and time, for messages

  bool is_equilibrium_waited_for_ = false;
  double spent_before_ = 0.0; ///< computing time at the last balance_load() [s]
};

template <class MoveOthers>
void CoupledSystem::step(MoveOthers&& move_others)
{
  if (n_steps % dem::steps_between_step_checks == 0) check_time_step();
  if (n_steps % steps_between_load_checks == 0) balance_load();

  const auto move_walls = [&](double h) {
    move_structures(h);
    move_others(h);
  };
  try {
    // Particles get v^{n+1/2} and x^{n+1}, then the walls move, then follow the forces at
    // x^{n+1}.
    dem::advance(assembly, dt_before, dt, move_walls);
  } catch (const Unstable& e) {
    throw Unstable(e.what() + where());
  } catch (const NumericalError& e) {
    throw NumericalError(e.what() + where());
  }
  dt_before = dt;
  time += dt;
  ++n_steps;
}

} // namespace mergel::coupling
