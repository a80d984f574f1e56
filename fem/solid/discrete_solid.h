/// An elastic solid as arrays, for time stepping and static solutions; it has no mesh.
#pragma once

#include "fem/solid/block_matrix.h"

#include <cstdint>

namespace mergel::fem {

/// Supports are one orthogonal projector P_a per node: I where free, I - n n^T on a roller,
/// 0 where fixed. Displacements, velocities and forces live in the range of P, and
///
///   K = P K_free P + kappa (I - P)
///
/// is symmetric, positive definite if rigid motions are prevented, and maps this range into
/// itself (fem/README.md, Boundary conditions).
struct DiscreteSolid {
  std::vector<Vec3> x;  ///< reference position of each node [m]
  std::vector<Mat3> P;  ///< support of each node [-]
  Eigen::ArrayXd m;     ///< lumped mass of each node [kg], > 0
  NodalField f_gravity; ///< P times the weight [N]
  /// P times (int B^T sigma_0 dx + int p n N dA): nodal forces of the initial stress, less
  /// those of the pressures on the surface [N].
  NodalField f_initial;
  BlockMatrix K;                      ///< stiffness with supports [N/m]
  std::vector<std::uint32_t> oblique; ///< nodes whose P mixes the axes (not diagonal)

  std::size_t n_nodes() const { return x.size(); }
};

/// Largest omega [rad/s] of K u = omega^2 m u, by Lanczos iteration until the estimate
/// changes by less than 1e-6 of itself (fem/README.md, Stable step).
double largest_frequency(const DiscreteSolid& solid);
/// The same with other masses of the nodes [kg], and springs from the nodes to ground, equal in
/// all directions [N/m].
double largest_frequency(const DiscreteSolid& solid, const Eigen::ArrayXd& m,
                         const Eigen::ArrayXd& to_ground);

} // namespace mergel::fem
