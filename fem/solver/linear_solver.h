/// Static solutions K u = f (fem/README.md, Static solution).
#pragma once

#include "fem/solid/discrete_solid.h"
#include "fem/solid/shared_product.h"

namespace mergel::fem {

/// Result and cost of a static solution.
struct StaticSolution {
  NodalField u;        ///< displacement [m]
  int iterations = 0;  ///< of conjugate gradients
  double residual = 0; ///< |f - K u| / |f| [-], computed from u; 0 when f = 0
};

/// Solve K u = f to |f - K u| <= tolerance |f| by conjugate gradients, preconditioned with the
/// inverse of the diagonal blocks. The same bits on any number of ranks.
/// @param K product with solid.K; each of its ranks calls this with the same forces
/// @param f nodal forces [N]; projected with P here, so reactions may be left in
/// Throws std::runtime_error when the iteration does not converge, or the residual is above a
/// hundred times the tolerance (a rigid motion is not prevented).
StaticSolution solve_static(const DiscreteSolid& solid, SharedProduct& K,
                            const NodalField& f, double tolerance = 1e-12);
/// The same on this process alone.
StaticSolution solve_static(const DiscreteSolid& solid, const NodalField& f,
                            double tolerance = 1e-12);

} // namespace mergel::fem
