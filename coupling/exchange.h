/// One coupled step: velocities from the far field to the wall of the assembly, forces from
/// the wall to the far field (coupling/README.md, Coupled step).
#pragma once

#include "coupling/transfer.h"
#include "dem/walls/triangulated.h"
#include "fem/far_field/far_field.h"

namespace mergel::coupling {

/// The wall made of the interface faces of a far field, and the transfer between their
/// nodes.
///
/// Above the surface the wall has a collar, so that debris cannot roll over the rim. The
/// upper nodes of the collar follow the surface nodes below them (coupling/README.md,
/// Collar).
struct Interface {
  dem::Wall wall;
  Transfer transfer;
};

/// @param collar_height above the surface z = 0 [m]; 0 for no collar
Interface make_interface(const fem::InterfaceMesh& mesh, const dem::ContactLaw& material,
                         double collar_height);

/// Moves the wall of an assembly with a far field, one far-field step per DEM step.
class Exchange {
public:
  Exchange(Transfer transfer, fem::FarField& far_field);

  /// Forces of the wall nodes, summed to the far-field nodes: f_fem = N^T f_dem.
  const Nodal& sum_forces(const dem::Wall& wall);

  /// Static solution of a far field that has not moved yet, under the present wall forces
  /// (coupling/README.md, Start of a coupled run). Moves the wall nodes by it and sets
  /// their velocities to zero. Returns the displacements of the wall nodes [m].
  Nodal settle(dem::Wall& wall);

  /// One step of the far field under the wall forces, then the motion of the wall nodes
  /// with it over dt [s].
  void step(dem::Wall& wall, double dt);

  const Nodal& far_field_velocities() const { return v_fem_; }
  const Transfer& transfer() const { return transfer_; }

  /// Wall-clock time spent in the far field and in the exchange itself [s].
  double far_field_seconds = 0.0, exchange_seconds = 0.0;

private:
  Transfer transfer_;
  fem::FarField& far_field_;
  Nodal f_dem_, f_fem_, v_fem_;
};

/// Displacement at a point of a region whose boundary nodes x have moved by u [m]:
/// inverse-distance weights of power 3, exact for translations.
dem::Vec3 interpolate_inside(const Nodal& x, const Nodal& u, const dem::Vec3& at);

} // namespace mergel::coupling
