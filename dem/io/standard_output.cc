#include "dem/io/standard_output.h"

#include "dem/error.h"

#include <iostream>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace mergel::dem {

void hold_standard_descriptors()
{
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The lowest free number is taken. What cannot be written to fails as the closed one.
    if (::fcntl(number, F_GETFD) < 0) [[maybe_unused]]
      const int held = ::open("/dev/null", O_RDONLY);
}

void require_printed()
{
  std::cout.flush();
  if (std::cout.good()) return;
  // The stream does not keep the system's reason: ask for the state of the descriptor.
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  ::poll(&out, 1, 0);
  if (out.revents & POLLERR) return; // a pipe without a reader
  const int flags = ::fcntl(STDOUT_FILENO, F_GETFL);
  const bool is_closed = flags < 0 || (flags & O_ACCMODE) == O_RDONLY;
  throw NumericalError(std::string("the standard output cannot be written: ") +
                       (is_closed ? "it is closed" : "is the disk full?"));
}

} // namespace mergel::dem
