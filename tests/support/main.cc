// Main of the test programs without MPI, for versions 2 and 3 of Catch2 alike.
#define CATCH_CONFIG_RUNNER
#include "tests/support/catch.h"

int main(int argc, char** argv)
{
  return Catch::Session().run(argc, argv);
}
