/// A structure moves one triangulated wall of an assembly and takes the forces of the
/// particles on it (coupling/README.md, Structure).
#pragma once

#include "coupling/transfer.h"
#include "dem/io/state/state_file.h"
#include "dem/walls/triangulated.h"

#include <optional>
#include <span>
#include <string>

namespace mergel::coupling {

/// The wall of a structure in its reference position, and the transfer between their nodes.
struct Interface {
  dem::Wall wall;
  Transfer transfer;
};

/// Energy of a structure at n+1/2 [J]:
///
///   change of (kinetic + strain) = wall_work + gravity_work + applied_work - damping
///
/// Works and damping are cumulative.
struct StructureEnergies {
  double kinetic = 0.0, strain = 0.0; ///< stored
  double wall_work = 0.0;             ///< done on the structure by the particles
  double gravity_work = 0.0;          ///< done by its weight
  double applied_work = 0.0;          ///< done by what else acts on it: its drive, its
                                      ///< initial stress
  double damping = 0.0;               ///< lost

  /// What the equation above leaves unexplained, but for a constant.
  double net() const
  {
    return kinetic + strain - wall_work - gravity_work - applied_work + damping;
  }
  StructureEnergies& operator+=(const StructureEnergies& other)
  {
    kinetic += other.kinetic;
    strain += other.strain;
    wall_work += other.wall_work;
    gravity_work += other.gravity_work;
    applied_work += other.applied_work;
    damping += other.damping;
    return *this;
  }
};

/// Finite elements or a rigid part, seen from its interface nodes. Nodal arrays have the
/// order of the columns of the transfer; forces are those of the particles on the
/// structure [N].
///
/// Every rank holds the complete structure and gets the same bits. It gives it the same forces,
/// but for a structure that shares its nodes. Member functions are collective.
///
/// Leapfrog, in step with the particles: positions belong to whole steps, velocities to
/// half steps, and the kick takes the mean of the old and the new step (the first kick the
/// whole new one).
class Structure {
public:
  virtual ~Structure() = default;

  /// The wall of its interface faces, with normals towards the particles.
  virtual Interface interface(const dem::ContactLaw& contact) const = 0;

  /// The nodes whose forces it wants on each rank; by default every rank has all. Nodes can be
  /// shared where the transfer is the identity.
  virtual dem::NodeShares shares() const { return {}; }

  /// Whether it takes part in the steps. One that does not is held in its reference
  /// position.
  virtual bool moves() const = 0;

  /// Nodes at t^{n+1} [m] and their velocities at n+1/2 [m/s]: the motion over the last
  /// step, divided by it. Resize their argument.
  virtual void positions(Nodal& x) const = 0;
  virtual void velocities(Nodal& v) const = 0;

  /// One step of dt [s] > 0 under the forces f at the present positions; where nodes are shared
  /// those of other ranks' nodes are not given.
  virtual void step(double dt, const Nodal& f) = 0;

  /// Static equilibrium under these forces, from the reference position: displacements of
  /// the nodes [m], in which the structure then is at rest. None for a structure that has
  /// no such solution; it stays where it is.
  virtual std::optional<Nodal> solve_static(const Nodal& f) = 0;

  /// For settling: masses with which no free motion is faster than omega2 [1/s^2], from rest.
  /// Its weight and the forces on it stay what they are. A structure without a stiffness of
  /// its own may keep its masses.
  /// @param stiffness of what is coupled to each interface node [N/m]
  virtual void equalise_frequencies(double omega2, std::span<const double> stiffness) = 0;
  /// The true masses again, at rest.
  virtual void restore_masses() = 0;

  /// How a structure takes its own forces: by impulse, at every n-th step.
  struct Subcycle {
    std::size_t n = 1;
    double limit = 1.0; ///< of n, by the frequencies [-]
  };
  /// Choose the largest n up to `most` with n dt below `longest` [s] and below 0.7 over its
  /// largest frequency, springs to the particles included. It is part of its state.
  /// @param stiffness of what is coupled to each interface node [N/m]
  virtual void choose_subcycle(double dt, std::span<const double> stiffness, double longest,
                               std::size_t most) = 0;
  virtual Subcycle subcycle() const = 0;

  /// Local damping [-].
  virtual double damping() const = 0;

  /// Its linear system M a + K u = f, for the largest frequency of a coupled system. The
  /// amplitudes y are M^1/2 u of all that is free to move.
  virtual std::size_t n_amplitudes() const = 0;
  /// Motion of the nodes under these amplitudes [kg^-1/2]. Resizes its argument.
  virtual void move(std::span<const double> y, Nodal& u) const = 0;
  /// M^-1/2 (K M^-1/2 y + J^T f) into `to`: f resists the motion of the nodes, J u = that
  /// motion.
  virtual void multiply(std::span<const double> y, const Nodal& f,
                        std::span<double> to) const = 0;

  /// Unbalanced over acting forces at the last kick [-]; 0 if nothing is free to move.
  virtual double unbalanced_ratio() const = 0;

  virtual StructureEnergies energies() const = 0;

  /// Add its state under names that begin with `name`.
  virtual void save(dem::State& state, const std::string& name) const = 0;
  /// Continue with the same bits. @throws InputError when the state is of another structure
  virtual void load(const dem::State& state, const std::string& name) = 0;

protected:
  Structure() = default;
  Structure(const Structure&) = default;
  Structure& operator=(const Structure&) = default;
};

} // namespace mergel::coupling
