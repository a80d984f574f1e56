/// What only one of several ranks does: files, and words to the user.
#pragma once

#include "dem/error.h"

#include <mpi.h>
#include <stdexcept>
#include <string>

namespace mergel::apps {

inline int rank_of_world()
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline bool is_first_rank()
{
  return rank_of_world() == 0;
}

/// Run `body` on the first rank while the others wait. Bad input found there is thrown on
/// all, so that the run ends with its exit code; any other exception goes on where it is.
template <class Body>
void on_first_rank(Body&& body)
{
  std::string message;
  if (is_first_rank()) {
    try {
      body();
    } catch (const std::invalid_argument& error) { // as run_guard.h sees bad input
      message = error.what();
      if (message.empty()) message = "bad input";
    }
  }
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (length == 0) return;
  message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(message.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
  throw InputError(message);
}

/// Run `body` on every rank. Bad input that one finds, say a file that only it cannot see,
/// is thrown on all; any other exception goes on where it is.
template <class Body>
void on_every_rank(Body&& body)
{
  std::string message;
  try {
    body();
  } catch (const std::invalid_argument& error) {
    message = error.what();
    if (message.empty()) message = "bad input";
  }
  int n_ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  int first = message.empty() ? n_ranks : rank_of_world();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == n_ranks) return;
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, first, MPI_COMM_WORLD);
  message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(message.data(), length, MPI_CHAR, first, MPI_COMM_WORLD);
  throw InputError(message);
}

} // namespace mergel::apps
