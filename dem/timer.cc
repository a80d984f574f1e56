#include "dem/timer.h"

#include <chrono>

namespace mergel::dem {

double wall_clock()
{
  using clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(clock::now().time_since_epoch()).count();
}

} // namespace mergel::dem
