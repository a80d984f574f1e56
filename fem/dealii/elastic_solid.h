/// Linear elastic solid on a hexahedral mesh: assembles the arrays of a DiscreteSolid
/// (fem/README.md, Equations).
#pragma once

#include "fem/dealii/elasticity.h"
#include "fem/solid/discrete_solid.h"

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

#include <functional>
#include <map>

namespace mergel::fem {

/// Support of the nodes of one boundary id.
enum class Support {
  fixed,  ///< u = 0
  roller, ///< u.n = 0, n the area-weighted mean normal of the id's faces at the node: a
          ///< curved side takes one id, two planes that meet at an edge take two
};

using Supports = std::map<dealii::types::boundary_id, Support>;

/// Material and loads of the solid.
struct SolidProperties {
  Elastic elastic;
  double rho = 0.0;            ///< bulk density [kg/m^3], > 0
  Vec3 gravity = Vec3::Zero(); ///< [m/s^2]
  /// Stress before any displacement [Pa], tension positive; empty for none.
  std::function<dealii::SymmetricTensor<2, 3>(const dealii::Point<3>&)> initial_stress;
  /// Pressure on the faces of a boundary id in their reference position [Pa], >= 0: a dead
  /// load against their normals.
  std::map<dealii::types::boundary_id, double> pressure;
};

/// Trilinear hexahedra (Q1), small strain, mass lumped by row sums. Nodes are numbered in
/// the order of deal.II's vertex unknowns, cell by cell. The mesh is borrowed and must
/// outlive the solid.
class ElasticSolid {
public:
  /// Throws std::invalid_argument when a support names an id that no boundary face carries.
  ElasticSolid(const dealii::Triangulation<3>& mesh, SolidProperties properties,
               const Supports& supports);

  const DiscreteSolid& discrete() const { return discrete_; }
  const dealii::DoFHandler<3>& dofs() const { return dofs_; }
  const SolidProperties& properties() const { return properties_; }

  /// Node at a vertex of a cell of dofs().
  static std::uint32_t node(const dealii::DoFHandler<3>::active_cell_iterator& cell,
                            unsigned int vertex)
  {
    return cell->vertex_dof_index(vertex, 0) / 3;
  }

  /// Nodes of all faces with this boundary id, ascending.
  std::vector<std::uint32_t> nodes_on(dealii::types::boundary_id id) const;

  /// Mean stress of each active cell, sigma_0 + C : eps(u) [Pa], tension positive.
  std::vector<dealii::SymmetricTensor<2, 3>> cell_stress(const NodalField& u) const;

private:
  void set_supports(const Supports& supports);
  void set_pattern();
  void assemble();
  void add_pressures();

  SolidProperties properties_;
  dealii::FESystem<3> fe_;
  dealii::DoFHandler<3> dofs_;
  DiscreteSolid discrete_;
};

} // namespace mergel::fem
