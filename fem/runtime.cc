#include "fem/runtime.h"

#include <deal.II/base/mpi.h>

#include <array>

namespace mergel::fem {

struct Runtime::Libraries {
  Libraries(int argc, char** argv) : name{argc > 0 ? argv[0] : nullptr, nullptr} {}

  // MPI_InitFinalize keeps references to these two.
  std::array<char*, 2> name;
  int n_arguments = 1;
  char** arguments = name.data();
  dealii::Utilities::MPI::MPI_InitFinalize init{n_arguments, arguments, 1};
};

Runtime::Runtime(int argc, char** argv)
    : libraries_(std::make_unique<Libraries>(argc, argv))
{
}
Runtime::~Runtime() = default;

} // namespace mergel::fem
