/// Static solves K u = f with PETSc, on one process.
#pragma once

#include "fem/solid/discrete_solid.h"

namespace mergel::fem {

enum class StaticMethod {
  multigrid, ///< conjugate gradients, smoothed aggregation (GAMG) with the rigid-body modes
  direct,    ///< Cholesky factors (MUMPS); dearer from a few thousand cells on
};

/// What a static solve took.
struct StaticSolution {
  Nodal u;             ///< displacement [m]
  int iterations = 0;  ///< of conjugate gradients; 1 when direct
  double residual = 0; ///< |f - K u| / |f| [-], computed afresh; 0 when f = 0
};

/// Solve K u = f to |f - K u| <= tolerance |f|.
/// @param f nodal forces [N]; projected with P here, so reactions may be left in
/// Throws std::runtime_error when PETSc fails, the iteration does not converge, or the
/// solution leaves a residual above a hundred times the tolerance (a rigid motion is not
/// held).
StaticSolution solve_static(const DiscreteSolid& solid, const Nodal& f,
                            StaticMethod method = StaticMethod::multigrid,
                            double tolerance = 1e-12);

} // namespace mergel::fem
