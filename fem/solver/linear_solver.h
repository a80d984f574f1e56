/// Static solutions K u = f with PETSc, on one process (fem/README.md, Static solution).
#pragma once

#include "fem/solid/discrete_solid.h"

namespace mergel::fem {

enum class StaticMethod {
  multigrid, ///< conjugate gradients, smoothed aggregation (GAMG) with the rigid-body modes
  direct,    ///< Cholesky factors (MUMPS); slower above a few thousand cells
};

/// Result and cost of a static solution.
struct StaticSolution {
  NodalField u;        ///< displacement [m]
  int iterations = 0;  ///< of conjugate gradients; 1 when direct
  double residual = 0; ///< |f - K u| / |f| [-], computed from u; 0 when f = 0
};

/// Solve K u = f to |f - K u| <= tolerance |f|.
/// @param f nodal forces [N]; projected with P here, so reactions may be left in
/// Throws std::runtime_error when PETSc fails, the iteration does not converge, or the
/// residual is above a hundred times the tolerance (a rigid motion is not prevented).
StaticSolution solve_static(const DiscreteSolid& solid, const NodalField& f,
                            StaticMethod method = StaticMethod::multigrid,
                            double tolerance = 1e-12);

} // namespace mergel::fem
