// Main of the test programs that link fem/: PETSc and deal.II must be initialised once.
#define CATCH_CONFIG_RUNNER
#include "tests/support/catch.h"

#include "fem/runtime.h"

int main(int argc, char** argv)
{
  const mergel::fem::Runtime runtime(argc, argv);
  return Catch::Session().run(argc, argv);
}
