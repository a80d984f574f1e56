#include "tests/support/repository.h"

namespace mergel::test {

std::filesystem::path repository()
{
  return MERGEL_REPOSITORY;
}

} // namespace mergel::test
