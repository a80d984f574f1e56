/// The last catch of a program: one message and the exit code of whatever went wrong.
///
///   0 done   1 bad input   2 numerical or system failure   3 bug
///
/// InputError and std::invalid_argument are 1, NumericalError, std::runtime_error, lack of
/// memory and deal.II's errors are 2, all else is 3.
#pragma once

#include "apps/words.h"
#include "dem/collective_failure.h"

#include <mpi.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

namespace mergel::apps {

enum ExitCode : int { exit_done = 0, exit_input = 1, exit_failure = 2, exit_bug = 3 };

/// What to print, and how the program ends.
struct Verdict {
  int code;
  std::string message;        ///< one line
  bool is_collective = false; ///< found alike on all ranks
};

/// Judge the exception that is being handled. @pre called from a catch block
inline Verdict judge_current_exception()
{
  try {
    throw;
  } catch (const std::invalid_argument& error) {
    return {exit_input, in_one_line(error.what()), true};
  } catch (const CollectiveFailure& error) {
    return {exit_failure, in_one_line(error.what()), true};
  } catch (const std::runtime_error& error) {
    return {exit_failure, in_one_line(error.what())};
  } catch (const std::bad_alloc&) {
    return {exit_failure,
            "out of memory. Use fewer particles (a larger S) or a coarser mesh, "
            "or a machine with more"};
  } catch (const std::exception& error) {
    const std::string text = in_one_line(error.what());
    // dealii::ExceptionBase is known by its text only: this header stays free of deal.II
    // in Release it is thrown by checks of a run, not of the program.
    if (text.find("An error occurred in line <") != std::string::npos &&
        text.find("ExcInternalError") == std::string::npos)
      return {exit_failure, text};
    return {exit_bug, "mergel: internal error: " + text + (text.ends_with('.') ? "" : ".") +
                          " Please report this with the case file and the command line."};
  } catch (...) {
    return {exit_bug, "mergel: internal error: an exception of unknown type. Please report "
                      "this with the case file and the command line."};
  }
}

/// The rank that the launcher gave this process, known before MPI is up; -1 without one.
inline int launched_rank()
{
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return -1;
}

/// Run `body` and return its exit code, or print what it threw on std::cerr and return the
/// code of that.
///
/// Call it while MPI is up if the body uses MPI: an exception must not unwind past
/// MPI_Finalize. Bad input is found alike on all ranks, and so is a CollectiveFailure: rank
/// 0 speaks and all return. Any other exception on one of several ranks would leave the
/// others waiting: it names its rank and calls MPI_Abort.
template <class Body>
int run_guarded(const Body& body)
{
  try {
    return body();
  } catch (...) {
    const Verdict verdict = judge_current_exception();

    int is_up = 0, is_down = 0, rank = 0, n_ranks = 1;
    MPI_Initialized(&is_up);
    MPI_Finalized(&is_down);
    if (!is_up && launched_rank() >= 0) {
      // The launcher ends the job at the first exit: the first rank must have spoken by then.
      MPI_Init(nullptr, nullptr);
      if (launched_rank() == 0) std::cerr << verdict.message << std::endl;
      MPI_Finalize();
      return verdict.code;
    }
    if (is_up && !is_down) {
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    }
    if (n_ranks == 1 || verdict.is_collective) {
      if (rank == 0) std::cerr << verdict.message << std::endl;
      return verdict.code;
    }
    std::cerr << "rank " << rank << ": " << verdict.message << std::endl;
    MPI_Abort(MPI_COMM_WORLD, verdict.code);
    return verdict.code;
  }
}

} // namespace mergel::apps
