/// Initialisation and finalisation of MPI, PETSc and the libraries of deal.II.
#pragma once

#include <memory>

namespace mergel::fem {

/// One per program, made first in main and destroyed last. PETSc does not get the command
/// line (it would answer --help itself); it reads its options from the environment variable
/// PETSC_OPTIONS.
class Runtime {
public:
  Runtime(int argc, char** argv);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

private:
  struct Libraries;
  std::unique_ptr<Libraries> libraries_;
};

} // namespace mergel::fem
