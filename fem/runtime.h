/// Start and end of MPI, PETSc and the libraries that deal.II brings.
#pragma once

#include <memory>

namespace mergel::fem {

/// One per program, made first in main and destroyed last. PETSc is not shown the command
/// line (it would answer --help itself); its options are read from the variable
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
