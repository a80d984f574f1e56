/// What only one of several ranks does, or meets: files, and words to the user.
#pragma once

#include "dem/collective_failure.h"

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

/// Give every rank the text of one.
inline void share(std::string& text, int from = 0)
{
  auto length = static_cast<unsigned long long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, from, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, from, MPI_COMM_WORLD);
}

/// Run `body`, which must not be collective, on the ranks where `is_mine`. What it throws as
/// bad input (InputError) or as a failure of run or system (CollectiveFailure) is thrown on
/// all ranks alike, that of the lowest rank; any other exception goes on where it is.
template <class Body>
void on_ranks(bool is_mine, Body&& body)
{
  std::string message;
  bool is_input = false;
  if (is_mine) {
    try {
      body();
    } catch (const std::invalid_argument& error) { // as run_guard.h sees bad input
      is_input = true;
      message = *error.what() ? error.what() : "bad input";
    } catch (const std::runtime_error& error) {
      message = *error.what() ? error.what() : "unknown failure";
    }
  }
  int n_ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  int first = message.empty() ? n_ranks : rank_of_world();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == n_ranks) return;
  int kind = is_input;
  MPI_Bcast(&kind, 1, MPI_INT, first, MPI_COMM_WORLD);
  share(message, first);
  if (first > 0) message = "rank " + std::to_string(first) + ": " + message;
  if (kind == 1) throw InputError(message);
  throw CollectiveFailure(message);
}

/// Run `body` on the first rank while the others wait.
template <class Body>
void on_first_rank(Body&& body)
{
  on_ranks(is_first_rank(), body);
}

/// Run `body` on every rank: say, read a file that one of them may not see.
template <class Body>
void on_every_rank(Body&& body)
{
  on_ranks(true, body);
}

} // namespace mergel::apps
