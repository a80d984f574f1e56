/// Rocks made from a seed alone, on which the cost of a step is measured; tests/bench says
/// what they stand for.
///
/// Both have N spheres with diameters uniform in [0.8, 1.2] units, a unit being the mean
/// grain of the paper's rock, numbered along a space-filling curve. Both fly along x, so
/// fast that the lists go stale every 250 steps, as under a pile: they are otherwise at rest
/// or nearly so, and the flight changes no force.
#pragma once

#include "dem/assembly/step.h"

#include <cstdint>

namespace mergel::apps {

enum class Workload {
  /// W1: a block with 2.45 bonds a particle and free faces, compressed slowly along z.
  bonded_block,
  /// W2: no bonds; 3.4 frictional contacts a particle in a periodic cube, slightly agitated.
  frictional_packing
};

struct WorkloadSpec {
  Workload workload = Workload::bonded_block;
  std::size_t n_particles = 50000;
  std::uint64_t seed = 1;
  /// Share of the bonds of W1 that yield in a step [-]; 0: their strength is out of reach.
  double yielding = 0.0;

  /// @throws InputError when out of range
  void check() const;
};

/// Bonds of a particle in W1, and contacts of a particle that W2 aims at.
inline constexpr double bonds_per_particle = 2.45, contacts_per_particle = 3.4;

/// A rock that moves by itself.
struct WorkingRock {
  dem::Rock rock;
  double dt = 0.0;        ///< present step [s]; only ever lowered
  double dt_before = 0.0; ///< the step before [s]
  std::size_t n_steps = 0;

  /// One step as a run takes it, the stable step looked at every hundredth time.
  void step();
};

/// The same spec gives the same bits.
///
/// W1, overdamped: spheres in a periodic cube grow until they fill 0.6 of it with their
/// far-field shells, the cube is cut open at its faces, and the closest pairs are bonded. The
/// particles of its two ends are so heavy that they keep their speed: platens that hold the
/// block by its bonds. It is squeezed from the start in the same ratio everywhere, so that no
/// wave runs. With `yielding` it has the strengths of the paper's rock but never softens; it
/// is squeezed until about that share of the bonds yields in a step, then more slowly, so
/// that the share lasts for a thousand steps.
///
/// W2, overdamped: spheres grow until each has 3.4 contacts, then settle with friction, and
/// each gets a small velocity of its own.
/// @throws InputError as spec.check(); NumericalError when the share or the number of
///   contacts is not reached
WorkingRock make_workload(const WorkloadSpec& spec);

/// Contacts that press, those beside bonds left out.
std::size_t count_contacts(const dem::Rock& rock);

/// 64 bits of FNV-1a over x, v, omega of all particles in order of their id. Source: Fowler,
/// Noll, Vo (1991).
std::uint64_t checksum(const dem::Particles& p);

} // namespace mergel::apps
