/// One coupling step: velocities down from the far field to the wall of the rock, forces
/// up.
#pragma once

#include "coupling/transfer.h"
#include "dem/walls/triangulated.h"
#include "fem/far_field/far_field.h"

namespace mergel::coupling {

/// The wall that the interface faces of a far field make, and how their nodes belong
/// together.
///
/// Above the surface the wall ends in a lip that follows the top ring of nodes, so that
/// debris cannot roll over it.
struct Interface {
  dem::Wall wall;
  Transfer transfer;
};

/// @param lip height above the surface z = 0 [m], 0 for none
Interface make_interface(const fem::InterfaceMesh& mesh,
                         const dem::LinearMaterial& material, double lip);

/// Moves the wall of a rock with a far field, one far-field step per DEM step.
class Exchange {
public:
  Exchange(Transfer transfer, fem::FarField& far_field);

  /// Forces of the wall nodes, summed to the far-field nodes: f_fem = N^T f_dem.
  const Nodal& forces_up(const dem::Wall& wall);

  /// For a far field that has not moved yet: static equilibrium under the present wall forces (design section 8),
  /// wall nodes at rest in its displaced place. Returns the displacement of the wall nodes
  /// [m].
  Nodal settle(dem::Wall& wall);

  /// Kick and drift the far field with the wall's forces, then move the wall with it over
  /// dt [s].
  void step(dem::Wall& wall, double dt);

  const Nodal& far_field_forces() const { return f_fem_; }
  const Nodal& far_field_velocities() const { return v_fem_; }
  const Transfer& transfer() const { return transfer_; }

  /// Wall-clock time spent in the far field and in the exchange itself [s].
  double far_field_seconds = 0.0, exchange_seconds = 0.0;

private:
  Transfer transfer_;
  fem::FarField& far_field_;
  Nodal f_dem_, f_fem_, v_fem_;
};

/// Displacement field inside a region whose border nodes x moved by u: inverse-distance
/// weights of power 3, exact for translations [m].
dem::Vec3 interpolate_inside(const Nodal& x, const Nodal& u, const dem::Vec3& at);

} // namespace mergel::coupling
