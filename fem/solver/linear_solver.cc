#include "fem/solver/linear_solver.h"

#include <Eigen/LU>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mergel::fem {
namespace {

NodalField projected(const DiscreteSolid& solid, const NodalField& f)
{
  NodalField Pf = NodalField::Zero(4, f.cols());
  for (Eigen::Index a = 0; a < f.cols(); ++a)
    Pf.col(a).head<3>() = (solid.P[static_cast<std::size_t>(a)] * at(f, a)).array();
  return Pf;
}

double length(const NodalField& f)
{
  return std::sqrt(dot(f, f));
}

/// The block-diagonal part of a matrix, to be inverted.
class DiagonalBlocks {
public:
  explicit DiagonalBlocks(const BlockMatrix& A)
  {
    inverse_.reserve(A.n_rows());
    A.for_each([&](std::uint32_t i, std::uint32_t j, const Mat3& B) {
      if (i == j) inverse_.push_back(B.inverse()); // positive definite, see DiscreteSolid
    });
  }

  /// z = D^-1 r
  void solve(const NodalField& r, NodalField& z) const
  {
    z.setZero(4, r.cols());
    for (Eigen::Index a = 0; a < r.cols(); ++a)
      z.col(a).head<3>() = (inverse_[static_cast<std::size_t>(a)] * at(r, a)).array();
  }

private:
  std::vector<Mat3> inverse_;
};

[[noreturn]] void fail(double residual, double tolerance, int iterations)
{
  std::ostringstream message;
  message << "static solve of the far field: relative residual " << residual << " after "
          << iterations << " iterations, " << tolerance
          << " wanted; is every rigid motion prevented, and is nu below 0.499?";
  throw std::runtime_error(message.str());
}

} // namespace

// All bits of a coupled run follow from this solution, so it is made of sums in one fixed order.
// A library's solver is not: PETSc from 3.20 on chooses by the addresses of its vectors how it
// sums (-vec_mdot_use_gemv), which differ with what was in memory before, and a BLAS may sum
// with as many threads as the rank has processors.
StaticSolution solve_static(const DiscreteSolid& solid, SharedProduct& K,
                            const NodalField& f, double tolerance)
{
  constexpr int max_iterations = 50'000; // 1,700 for 74,000 cells
  StaticSolution solution;
  NodalField& u = solution.u;
  u = NodalField::Zero(4, f.cols());
  const NodalField load = projected(solid, f);
  const double whole = length(load);
  if (whole == 0.0) return solution;

  const DiagonalBlocks D(solid.K);
  NodalField r = load, z, p = NodalField::Zero(4, f.cols()), Kp;
  double r_z = 1.0; // any, for p is zero
  while (length(r) > tolerance * whole) {
    D.solve(r, z);
    const double r_z_before = r_z;
    r_z = dot(r, z);
    p = z + (r_z / r_z_before) * p;
    K.multiply(p, Kp);
    const double p_Kp = dot(p, Kp);
    // K is singular if this is not positive, or not a number.
    if (!(p_Kp > 0.0) || solution.iterations == max_iterations)
      fail(length(r) / whole, tolerance, solution.iterations);
    const double step = r_z / p_Kp;
    u += step * p;
    r -= step * Kp;
    ++solution.iterations;
  }

  u = projected(solid, u); // the preconditioner leaves the range of P by round-off
  K.multiply(u, Kp);
  solution.residual = length(load - Kp) / whole;
  if (!(solution.residual <= 100.0 * tolerance))
    fail(solution.residual, tolerance, solution.iterations);
  return solution;
}

StaticSolution solve_static(const DiscreteSolid& solid, const NodalField& f,
                            double tolerance)
{
  SharedProduct K(solid.K, MPI_COMM_NULL);
  return solve_static(solid, K, f, tolerance);
}

} // namespace mergel::fem
