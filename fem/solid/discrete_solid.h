/// An elastic solid as arrays: all that time stepping and static solves need, and no mesh.
#pragma once

#include "fem/solid/block_matrix.h"

#include <cstdint>

namespace mergel::fem {

/// Supports are one orthogonal projector P_a per node: I where free, I - n n^T on a roller,
/// 0 where fixed. Displacements, velocities and forces live in the range of P, and
///
///   K = P K_free P + kappa (I - P)
///
/// stays symmetric, positive definite once rigid motions are held, and leaves that range
/// alone.
struct DiscreteSolid {
  std::vector<Vec3> x; ///< reference position of each node [m]
  std::vector<Mat3> P; ///< support of each node [-]
  Eigen::ArrayXd m;    ///< lumped mass of each node [kg], > 0
  Nodal f_gravity;     ///< P times the weight [N]
  Nodal f_initial; ///< P times int B^T sigma_0, the force that the initial stress holds [N]
  BlockMatrix K;   ///< stiffness with supports [N/m]
  std::vector<std::uint32_t> oblique; ///< nodes whose P mixes the axes (not diagonal)

  std::size_t n_nodes() const { return x.size(); }
};

/// Upper end of the spectrum: the largest omega [rad/s] of K u = omega^2 m u, by Lanczos
/// iteration until the estimate moves by less than 1e-6 of itself.
/// @param k_extra springs from node to ground added to the diagonal [N/m]; one per node or
/// none.
///   A bound for walls: N N^T <= diag(N) when the rows of N are >= 0 and sum to 1.
double largest_frequency(const DiscreteSolid& solid, const Eigen::ArrayXd& k_extra = {});

} // namespace mergel::fem
