// Main of the test programs that use MPI, which must be initialised once.
#define CATCH_CONFIG_RUNNER
#include "tests/support/catch.h"

#include "dem/parallel/mpi_session.h"

int main(int argc, char** argv)
{
  const mergel::dem::MpiSession mpi;
  return Catch::Session().run(argc, argv);
}
