/// Work of single ranks, such as files and messages to the user, whose failures all ranks
/// share.
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

/// Give every rank the text of rank `from`. Collective.
inline void share(std::string& text, int from = 0)
{
  auto length = static_cast<unsigned long long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, from, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, from, MPI_COMM_WORLD);
}

/// Run `task`, which must not be collective, on the ranks where `is_mine`. When it throws
/// bad input (std::invalid_argument) or a failure of run or system (std::runtime_error),
/// all ranks throw the message of the lowest such rank, as InputError or CollectiveFailure.
/// Any other exception leaves on its own rank only. Collective.
template <class Task>
void on_ranks(bool is_mine, Task&& task)
{
  std::string message;
  bool is_input = false;
  if (is_mine) {
    try {
      task();
    } catch (const std::invalid_argument& error) { // bad input, as in run_guard.h
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

/// Run `task` on the first rank while the others wait. Collective.
template <class Task>
void on_first_rank(Task&& task)
{
  on_ranks(is_first_rank(), task);
}

/// Run `task` on every rank, for example to read a file that one of them may not see.
/// Collective.
template <class Task>
void on_every_rank(Task&& task)
{
  on_ranks(true, task);
}

} // namespace mergel::apps
