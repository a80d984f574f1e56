/// The far field as a structure: elastic, or held rigid.
#pragma once

#include "coupling/structure.h"
#include "fem/far_field/far_field.h"

namespace mergel::coupling {

/// The wall made of the interface faces of a far field, and the transfer between their
/// nodes.
///
/// Above the surface the wall has a collar, so that debris cannot roll over the rim. The
/// upper nodes of the collar follow the surface nodes below them (coupling/README.md, Far
/// field).
/// @param collar_height above the surface z = 0 [m]; 0 for no collar
Interface make_interface(const fem::InterfaceMesh& mesh, const dem::ContactLaw& contact,
                         double collar_height);

/// A far field held rigid takes no part in the steps.
class FarFieldStructure final : public Structure {
public:
  enum class Model {
    elastic, ///< moves with the assembly
    rigid    ///< held in its reference position
  };

  /// @param collar_height above the surface [m]; 0 for no collar
  FarFieldStructure(fem::FarField far_field, Model model, double collar_height);

  const fem::FarField& far_field() const { return far_field_; }

  Interface interface(const dem::ContactLaw& contact) const override;
  bool moves() const override { return model_ == Model::elastic; }
  void positions(Nodal& x) const override;
  void velocities(Nodal& v) const override;
  void step(double dt, const Nodal& f) override;
  /// @throws std::runtime_error when the solver does not converge
  std::optional<Nodal> solve_static(const Nodal& f) override;
  void equalise_frequencies(double omega2, std::span<const double> stiffness) override
  {
    far_field_.equalise_frequencies(omega2, stiffness);
  }
  void restore_masses() override { far_field_.restore_masses(); }
  void choose_subcycle(double dt, std::span<const double> stiffness, double longest,
                       std::size_t most) override;
  Subcycle subcycle() const override
  {
    return {far_field_.motion().subcycle, subcycle_limit_};
  }
  double damping() const override { return far_field_.damping(); }
  std::size_t n_amplitudes() const override { return far_field_.n_amplitudes(); }
  void move(std::span<const double> y, Nodal& u) const override;
  void multiply(std::span<const double> y, const Nodal& f,
                std::span<double> to) const override;
  double unbalanced_ratio() const override;
  StructureEnergies energies() const override;
  void save(dem::State& state, const std::string& name) const override;
  void load(const dem::State& state, const std::string& name) override;

private:
  fem::FarField far_field_;
  Model model_;
  double collar_height_;
  double subcycle_limit_ = 1.0;
};

} // namespace mergel::coupling
