/// A membrane of finite elements around a specimen, as a structure (coupling/README.md,
/// Membrane).
#pragma once

#include "coupling/rigid_platen.h"
#include "fem/membrane/membrane_motion.h"

namespace mergel::coupling {

/// How the ends of a membrane are held at the platens. Along the axis they are tied to them.
enum class MembraneEnds {
  free, ///< they move freely in the planes of the platens
  fixed ///< they move with the platens
};

/// A tube whose ends are tied to two platens.
class MembraneStructure final : public Structure {
public:
  /// Borrows the platens, which must outlive it, and must be moved before it in a step.
  /// @param alpha local damping [-], in [0, 1)
  MembraneStructure(fem::Membrane membrane, const fem::Tube& tube, MembraneEnds ends,
                    double alpha, const RigidPlaten& bottom, const RigidPlaten& top);

  /// On the outside, from the step after the next kick by its own forces on [Pa].
  void set_pressure(double p) { motion_.set_pressure(p); }
  double pressure() const { return motion_.state().pressure; }

  const fem::MembraneMotion& motion() const { return motion_; }

  Interface interface(const dem::ContactLaw& contact) const override;
  dem::NodeShares shares() const override;
  bool moves() const override { return true; }
  void positions(Nodal& x) const override;
  void velocities(Nodal& v) const override;
  void step(double dt, const Nodal& f) override;
  /// None: it comes to rest together with the particles.
  std::optional<Nodal> solve_static(const Nodal& f) override;
  void equalise_frequencies(double omega2, std::span<const double> stiffness) override;
  void restore_masses() override;
  void choose_subcycle(double dt, std::span<const double> stiffness, double longest,
                       std::size_t most) override;
  Subcycle subcycle() const override;
  double damping() const override { return motion_.damping(); }
  std::size_t n_amplitudes() const override;
  void move(std::span<const double> y, Nodal& u) const override;
  /// With fem::Membrane::stiffness_bound() for its stiffness: a bound of its frequency.
  void multiply(std::span<const double> y, const Nodal& f,
                std::span<double> to) const override;
  double unbalanced_ratio() const override { return motion_.unbalanced_ratio(); }
  StructureEnergies energies() const override;
  /// Each rank writes the rows of its nodes.
  void save(dem::State& state, const std::string& name) const override;
  void load(const dem::State& state, const std::string& name) override;

private:
  std::size_t n_nodes() const { return motion_.membrane().rest().x.size(); }

  fem::MembraneMotion motion_;
  const RigidPlaten& bottom_;
  const RigidPlaten& top_;
  double subcycle_limit_ = 1.0;
  Nodal guided_; ///< velocities of the tied nodes [m/s]
};

} // namespace mergel::coupling
