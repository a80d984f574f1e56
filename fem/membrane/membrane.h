/// A membrane of triangles: its forces, masses, stiffness and fields (fem/README.md,
/// Membrane).
#pragma once

#include "fem/membrane/membrane_element.h"
#include "fem/membrane/node_shares.h"
#include "fem/membrane/tube.h"

#include <cstdint>

namespace mergel::fem {

/// Incompressible neo-Hookean, Poisson's ratio 1/2.
struct MembraneMaterial {
  double E = 0.0;         ///< Young's modulus at small strain [Pa], > 0
  double thickness = 0.0; ///< at rest [m], > 0
  double rho = 0.0;       ///< [kg/m^3], > 0
  Compression compression = Compression::wrinkles;

  double mu() const { return E / 3.0; } ///< shear modulus [Pa]
  /// @throws std::invalid_argument naming the value and what is allowed
  void check() const;
};

/// Fields of the triangles.
struct MembraneFields {
  std::vector<double> stretch_1, stretch_2; ///< principal, the larger first [-]
  std::vector<double> stress_1, stress_2;   ///< principal Cauchy stress [Pa]
  std::vector<double> state;                ///< 0 slack, 1 wrinkled, 2 taut [-]
  std::size_t n_wrinkled = 0, n_slack = 0;
};

/// Integrals of the Kirchhoff stress F S F^T over a membrane about the axis z [J]: N_z and
/// N_theta, the tensions of a line [N/m], times its area.
struct MembraneTensions {
  double axial = 0.0, hoop = 0.0;
};

/// A surface that two polygons close: those of its first and last row of nodes.
struct EnclosedVolume {
  double V = 0.0;                                ///< [m^3]
  Vec3 area[2] = {Vec3::Zero(), Vec3::Zero()};   ///< of the polygons, outwards [m^2]
  Vec3 centre[2] = {Vec3::Zero(), Vec3::Zero()}; ///< mean of their nodes [m]
};

class Membrane {
public:
  /// @param comm ranks that share the nodes; MPI_COMM_NULL: one rank, without MPI
  /// @throws std::invalid_argument as material.check()
  Membrane(SurfaceMesh rest, const MembraneMaterial& material,
           MPI_Comm comm = MPI_COMM_NULL);

  const SurfaceMesh& rest() const { return rest_; }
  const NodeShares& shares() const { return shares_; }
  const MembraneMaterial& material() const { return material_; }
  Eigen::Index n_nodes() const { return static_cast<Eigen::Index>(rest_.x.size()); }
  NodalField rest_positions() const;
  /// A third of its triangles' mass for each node [kg].
  Eigen::ArrayXd masses() const;

  /// Forces on the nodes of this rank at x under this pressure on the side from which the corners
  /// run clockwise: -dW/dx + p dV/dx. Of f other nodes may get any number. No bit depends on the
  /// number of ranks.
  void forces(const NodalField& x, double pressure, NodalField& f) const;

  double strain_energy(const NodalField& x) const; ///< [J]
  MembraneFields fields(const NodalField& x) const;
  MembraneTensions tensions(const NodalField& x) const;
  /// Of a tube; normals inwards.
  EnclosedVolume enclosed(const NodalField& x, const Tube& tube) const;
  /// Folds of more than 90 degrees between neighbouring triangles.
  std::size_t n_folds(const NodalField& x) const;

  /// For each node a stiffness k such that u.K u <= sum k |u|^2 for the tangent stiffness K
  /// at x [N/m]. A triangle has |d^2 W| <= mu (1 + 5 l^-6), l the smaller stretch, and 6 mu
  /// where it wrinkles.
  Eigen::ArrayXd stiffness_bound(const NodalField& x) const;

private:
  MembraneStrain<double> strain(std::size_t t, const NodalField& x) const;

  SurfaceMesh rest_;
  MembraneMaterial material_;
  std::vector<RestTriangle<double>> elements_;
  std::vector<std::array<std::size_t, 2>> edges_; ///< pairs of neighbouring triangles
  NodeShares shares_;
  Eigen::Index first_corner_, end_corner_; ///< nodes of the triangles of this rank's nodes
  std::vector<RestTriangle<Lanes>> batches_; ///< of the triangles of this rank's nodes
  std::vector<std::array<std::uint32_t, 3 * n_lanes>> corners_; ///< by batch
  std::size_t n_mine_ = 0; ///< triangles in the batches
};

/// The membrane of a tube at rest. @throws std::runtime_error as mesh_library() does
Membrane make_membrane(const Tube& tube, const MembraneMaterial& material,
                       MPI_Comm comm = MPI_COMM_NULL);

} // namespace mergel::fem
