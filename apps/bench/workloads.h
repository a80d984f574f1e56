/// Assemblies made from a seed alone, to measure the cost of a step. They are described in
/// tests/bench/README.md.
///
/// Both have N particles with diameters uniform in [0.8, 1.2] units, numbered along a
/// space-filling curve. A unit is the mean grain size of the paper's rock. Both move along
/// x with a uniform velocity at which the neighbour lists are rebuilt every 250 steps, as
/// under a pile. Otherwise they are nearly at rest. The uniform velocity changes no force.
#pragma once

#include "dem/assembly/step.h"
#include "dem/assembly/timestep.h"

#include <cstdint>

namespace mergel::apps {

enum class Workload {
  /// W1: a block with 2.45 bonds per particle and free faces, compressed slowly along z.
  bonded_block,
  /// W2: no bonds; 3.4 frictional contacts per particle in a periodic cube, small
  /// velocities.
  frictional_packing
};

struct WorkloadSpec {
  Workload workload = Workload::bonded_block;
  std::size_t n_particles = 50000;
  std::uint64_t seed = 1;
  /// Fraction of the bonds of W1 that yield in a step [-]; 0: their strength is not
  /// reached.
  double yielding = 0.0;

  /// @throws InputError when out of range
  void check() const;
};

/// Bonds per particle of W1, and target of the contacts per particle of W2 [-].
inline constexpr double bonds_per_particle = 2.45, contacts_per_particle = 3.4;

/// An assembly with its time step.
struct WorkingAssembly {
  dem::Assembly assembly;
  dem::StableStep stable_step;
  double dt = 0.0;        ///< time step [s]
  double dt_before = 0.0; ///< previous time step [s]
  std::size_t n_steps = 0;

  /// One step, as in a run; the stable time step is checked every 100 steps.
  void step();
};

/// Make a workload. The same spec gives the same bits.
///
/// W1: particles in a periodic cube grow without inertia until they fill 0.6 of it with
/// their far-field shells. The cube then becomes a block with free faces, and the closest
/// pairs are bonded. The particles at its two ends are so heavy that they keep their
/// velocity and act as platens. The initial velocities are those of a uniform strain rate,
/// so that no wave starts. With `yielding` the bonds have the strengths of the paper's rock
/// without softening; the block is compressed until about that fraction of the bonds yields
/// in a step, then more slowly, so that the fraction holds for a thousand steps.
///
/// W2: particles grow without inertia until there are 3.4 contacts per particle, then
/// settle with friction. Each particle then gets a small random velocity.
/// @throws InputError as spec.check(); NumericalError when the fraction or the number of
///   contacts is not reached
WorkingAssembly make_workload(const WorkloadSpec& spec);

/// Number of loaded contacts, without those beside bonds.
std::size_t count_contacts(const dem::Assembly& assembly);

/// 64 bits of FNV-1a over x, v, omega of all particles in order of their id. Source:
/// Fowler, Noll, Vo (1991).
std::uint64_t checksum(const dem::Particles& p);

} // namespace mergel::apps
