/// Initialisation and finalisation of MPI.
#pragma once

#include <mpi.h>

#include <cstdlib>

namespace mergel::dem {

/// One per program, before its first call of MPI. Only the thread of main calls MPI.
class MpiSession {
public:
  /// Does not see the command line, which is the program's own.
  MpiSession()
  {
    // For a program without launcher Open MPI 4 starts a daemon. It serves MPI_Comm_spawn alone
    // and takes half of the start.
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  }
  ~MpiSession() { MPI_Finalize(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

} // namespace mergel::dem
