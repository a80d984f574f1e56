#include "fem/solver/linear_solver.h"

#include <petscksp.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mergel::fem {
namespace {

void check(PetscErrorCode code, const char* call)
{
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("static solve of the far field: ") + call +
                           " failed: " + (text ? text : "unknown error") + " (PETSc code " +
                           std::to_string(code) + ")");
}

// Owners of PETSc handles. A destructor cannot throw: error codes of the Destroy calls are
// ignored.
struct Matrix {
  Mat it = nullptr;
  ~Matrix() { MatDestroy(&it); }
};
struct Vector {
  Vec it = nullptr;
  ~Vector() { VecDestroy(&it); }
};
struct Modes {
  MatNullSpace it = nullptr;
  ~Modes() { MatNullSpaceDestroy(&it); }
};
struct Solver {
  KSP it = nullptr;
  ~Solver() { KSPDestroy(&it); }
};

// GAMG needs the AIJ format and both halves of the matrix; K stores the upper half.
void copy_matrix(const BlockMatrix& K, Matrix& A)
{
  const auto n = static_cast<PetscInt>(3 * K.n_rows());
  std::vector<PetscInt> n_row(static_cast<std::size_t>(n), 0);
  K.for_each([&](std::uint32_t i, std::uint32_t j, const Mat3&) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      n_row[3 * i + c] += 3;
      if (j != i) n_row[3 * j + c] += 3;
    }
  });
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, n, n, 0, n_row.data(), &A.it), "MatCreateSeqAIJ");
  check(MatSetBlockSize(A.it, 3), "MatSetBlockSize");

  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const auto insert = [&](PetscInt i, PetscInt j, const RowMajor& B) {
    check(MatSetValuesBlocked(A.it, 1, &i, 1, &j, B.data(), INSERT_VALUES),
          "MatSetValuesBlocked");
  };
  K.for_each([&](std::uint32_t i, std::uint32_t j, const Mat3& B) {
    insert(static_cast<PetscInt>(i), static_cast<PetscInt>(j), B);
    if (j != i) insert(static_cast<PetscInt>(j), static_cast<PetscInt>(i), B.transpose());
  });
  check(MatAssemblyBegin(A.it, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  check(MatAssemblyEnd(A.it, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  check(MatSetOption(A.it, MAT_SPD, PETSC_TRUE), "MatSetOption");
}

void attach_rigid_body_modes(const std::vector<Vec3>& x, Matrix& A)
{
  Vector coordinates;
  check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(3 * x.size()), &coordinates.it),
        "VecCreateSeq");
  check(VecSetBlockSize(coordinates.it, 3), "VecSetBlockSize");
  PetscScalar* values = nullptr;
  check(VecGetArray(coordinates.it, &values), "VecGetArray");
  for (std::size_t a = 0; a < x.size(); ++a) Eigen::Map<Vec3>(values + 3 * a) = x[a];
  check(VecRestoreArray(coordinates.it, &values), "VecRestoreArray");
  Modes modes;
  check(MatNullSpaceCreateRigidBody(coordinates.it, &modes.it),
        "MatNullSpaceCreateRigidBody");
  check(MatSetNearNullSpace(A.it, modes.it), "MatSetNearNullSpace");
}

void choose(StaticMethod method, double tolerance, KSP ksp)
{
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  if (method == StaticMethod::direct) {
    check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
    check(PCSetType(pc, PCCHOLESKY), "PCSetType");
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
    return;
  }
  constexpr PetscInt max_iterations = 1000;
  check(KSPSetType(ksp, KSPCG), "KSPSetType");
  check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
  check(KSPSetTolerances(ksp, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, max_iterations),
        "KSPSetTolerances");
  // Not ML: that of Debian (Trilinos 13.2) writes past its arrays in
  // ML_Aggregate_Compress_Matrix on these matrices and corrupts the heap.
  check(PCSetType(pc, PCGAMG), "PCSetType");
}

} // namespace

StaticSolution solve_static(const DiscreteSolid& solid, const NodalField& f,
                            StaticMethod method, double tolerance)
{
  const std::size_t n = solid.n_nodes();
  const auto size = static_cast<PetscInt>(3 * n);
  StaticSolution solution;
  solution.u = NodalField::Zero(4, static_cast<Eigen::Index>(n));

  Eigen::VectorXd rhs(size), u = Eigen::VectorXd::Zero(size);
  for (std::size_t a = 0; a < n; ++a)
    rhs.segment<3>(static_cast<Eigen::Index>(3 * a)) =
        solid.P[a] * at(f, static_cast<Eigen::Index>(a));
  const double f_norm = rhs.norm();
  if (f_norm == 0.0) return solution;

  Matrix A;
  copy_matrix(solid.K, A);
  attach_rigid_body_modes(solid.x, A);

  Vector b, x;
  check(VecCreateSeqWithArray(PETSC_COMM_SELF, 3, size, rhs.data(), &b.it),
        "VecCreateSeqWithArray");
  check(VecCreateSeqWithArray(PETSC_COMM_SELF, 3, size, u.data(), &x.it),
        "VecCreateSeqWithArray");

  Solver ksp;
  check(KSPCreate(PETSC_COMM_SELF, &ksp.it), "KSPCreate");
  check(KSPSetOperators(ksp.it, A.it, A.it), "KSPSetOperators");
  choose(method, tolerance, ksp.it);
  check(KSPSetUp(ksp.it), "KSPSetUp");
  check(KSPSolve(ksp.it, b.it, x.it), "KSPSolve");

  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp.it, &reason), "KSPGetConvergedReason");
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(ksp.it, &iterations), "KSPGetIterationNumber");
  if (reason <= 0)
    throw std::runtime_error(std::string("static solve of the far field: stopped after ") +
                             std::to_string(iterations) + " iterations, " +
                             KSPConvergedReasons[reason] +
                             "; is every rigid motion prevented, and is nu below 0.499?");

  // The preconditioner leaves the range of P by round-off.
  for (std::size_t a = 0; a < n; ++a)
    solution.u.col(static_cast<Eigen::Index>(a)).head<3>() =
        (solid.P[a] * u.segment<3>(static_cast<Eigen::Index>(3 * a))).array();
  solution.iterations = static_cast<int>(iterations);

  NodalField Ku;
  solid.K.multiply(solution.u, Ku);
  double squares = 0.0;
  for (std::size_t a = 0; a < n; ++a)
    squares += (rhs.segment<3>(static_cast<Eigen::Index>(3 * a)) -
                at(Ku, static_cast<Eigen::Index>(a)))
                   .squaredNorm();
  solution.residual = std::sqrt(squares) / f_norm;
  if (!(solution.residual <= 100.0 * tolerance))
    throw std::runtime_error("static solve of the far field: relative residual " +
                             std::to_string(solution.residual) +
                             " against a tolerance of " + std::to_string(tolerance) +
                             "; is every rigid motion prevented?");
  return solution;
}

} // namespace mergel::fem
